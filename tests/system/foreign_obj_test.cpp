/// OBJ files as other programs write them, with the odd parts of the format: each is solved with --sky, or ends with a
/// message that names the file, the line and the fault.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/shell.h"

using namespace hemitex::tests;
using nlohmann::json;

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Outcome solveText(const Shell& shell, const std::string& file, const std::string& text) {
  writeAll(shell.file(file), text);
  return shell.run("solve '" + file + "' --sky 1,1,1 -o out --size 40x30 --json");
}

const std::string becomesGrey = "faces without a material become grey 0.5";

struct Foreign {
  std::string what, text;
  double area = 1;  ///< of the fronts, all of which see half of the sky
  std::vector<std::string> warnings = {becomesGrey};
};

}  // namespace

TEST_CASE("hemitex solve --sky lights OBJ files with odd syntax", "[cli]") {
  const Foreign foreign = GENERATE(values<Foreign>({
      {"relative indices", square + "f -4 -3 -2 -1\n"},
      {"relative indices amid vertices", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 0\nv 9 9 9\nf -4 -2 -3\n"},
      {"a missing MTL file",
       "mtllib none.mtl\n" + square + "usemtl gone\nf 1 2 3 4\n",
       1,
       {"the material file none.mtl cannot be read; its materials become grey 0.5",
        "materials that are in no material file become grey 0.5: 'gone'"}},
      {"a material without a file",
       square + "usemtl gone\nf 1 2 3 4\n",
       1,
       {"materials that are in no material file become grey 0.5: 'gone'"}},
      {"normals that are missing",
       square + "vn 0 0 1\nf 1//1 2//2 3//3 4//1\n",
       1,
       {"a face names the normal 2, which the file lacks (line 6); faces without normals are smooth by the angle "
        "between them",
        becomesGrey}},
      {"unused normals and texture coordinates", square + "vn 0 0 1\nvt 0 0\nf 1//1 2//1 3//1 4//1\n"},
      {"smoothing groups", square + "s 1\nf 1 2 3\ns off\nf 1 3 4\ns 0\n"},
      {"a polygon of five corners", square + "v 0.5 2 0\nf 1 2 3 5 4\n", 1.5},
      {"a concave polygon", square + "v 0.5 0.5 0\nf 1 2 3 5 4\n", 0.75},
      {"a polygon whose corners repeat", square + "f 1 2 2 3 4 4\n"},
      {"lines and points beside faces",
       square + "p 1 2\nl 1 2 3\nf 1 2 3 4\nl 3 4\np 1\n",
       1,
       {"only polygons are read; these statements are left out: `l` (line 6), `p` (line 5)", becomesGrey}},
      {"CRLF", "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\ng sheet\r\nf 1 2 3 4\r\n"},
      {"colours after vertices", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nf 1 2 3 4\n", 1, {}},
      {"a weight after vertices", "v 0 0 0 1.0\nv 1 0 0 1.0\nv 1 1 0 1.0\nv 0 1 0 1.0\nf 1 2 3 4\n"},
      {"tabs and spaces", "v\t0 0  0\n  v 1\t\t0 0 \nv 1 1 0\nv 0 1 0\n\tf  1 2 3\t4 \n"},
      {"comments and empty lines", "# a scene\n\n" + square + "#f 1 2 3\nf 1 2 3 4 # face\n\n"},
      {"no line end at the end", square + "f 1 2 3 4"},
      {"unknown keywords", square + "vp 0.1\ncstype bezier\ndeg 3\nmg 1\nlod 2\nshadow_obj a.obj\nf 1 2 3 4\nend\n"},
      {"names with spaces", square + "o the sheet\ng front side\nf 1 2 3 4\n"},
      {"a group without a name", square + "g\nf 1 2 3 4\n"},
      {"two names in a group", square + "g sheet flat\nf 1 2 3 4\n"},
      {"a group that occurs twice", square + "g a\nf 1 2 3\ng b\ng a\nf 1 3 4\n"},
      {"numbers without a leading zero", "v .0 -.0 0.\nv 1. 0e0 0\nv 1E0 1.0e+00 0\nv 0 +1 0\nf 1 2 3 4\n"},
      {"a texture coordinate with three numbers",
       square + "vt 0 0 0\nvt 1 0 0\nvt 1 1 0\nvt 0 1 0\nf 1/1 2/2 3/3 4/4\n"},
      {"texture coordinates outside of [0, 1]", square + "vt -3 0\nvt 7 0\nvt 7 9\nvt -3 9\nf 1/1 2/2 3/3 4/4\n"},
      {"texture coordinates at one point", square + "vt 0 0\nf 1/1 2/1 3/1 4/1\n"},
      {"a face without area beside others",
       square + "f 1 1 2\nf 1 2 3 4\n",
       1,
       {"1 face without area dropped (line 5)", becomesGrey}},
  }));
  INFO(foreign.what);
  const Shell shell;
  const Outcome outcome = solveText(shell, "a scene.obj", foreign.text);
  INFO(outcome.err);
  REQUIRE(outcome.exitCode == 0);
  const json solution = json::parse(outcome.out);
  // The beams that stand for the sky are spread evenly: their irradiance errs by about 1e-5.
  CHECK(solution["energy"]["emitted"][0].get<double>() == Approx(foreign.area).epsilon(1e-4));
  CHECK(solution["warnings"] == json(foreign.warnings));
}

TEST_CASE("hemitex solve --sky names the fault of an OBJ file that it cannot read", "[cli]") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"", "no face with area"},
      {square, "no face with area"},
      {square + "l 1 2 3 4\n", "no face with area"},
      {square + "p 1 2\n", "no face with area"},
      {square + "f 1 1 1\n", "no face with area"},
      {square + "f 1 2\n", ":5: a face has at least 3 corners"},
      {square + "f 0 1 2\n", ":5: index 0 in a face"},
      {square + "f 1 2 9\n", ":5: index 9 is out of range"},
      {square + "f -1 -2 -9\n", ":5: index -9 is out of range"},
      {square + "f 1/1 2/1 3/1\n", ":5: index 1 is out of range"},
      {square + "v 0 nan 0\nf 1 2 5\n", ":5: 'nan' is not a finite number"},
      {square + "v 0 x 0\nf 1 2 5\n", ":5: 'x' is not a number"},
      {square + "v 0 0\nf 1 2 5\n", ":5: a vertex has 3 coordinates"},
  }));
  const Shell shell;
  const Outcome outcome = solveText(shell, "odd.obj", text);
  INFO(text << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find("odd.obj") != std::string::npos);
  CHECK(outcome.err.find(message) != std::string::npos);
}
