// parseObj: exact numbers, errors with their line, and the structure of the format.
#include "radiosity/meshes/obj_file.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using radiosity::parseObj;
using radiosity::PolygonMesh;

namespace {

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// The corners of a polygon as `position` or `position/texcoord`, counted from 0.
std::string cornersOf(const PolygonMesh& obj, std::size_t polygon) {
  std::string text;
  const radiosity::MeshPolygon& p = obj.polygons[polygon];
  for (std::uint32_t c = p.firstCorner; c < p.firstCorner + p.cornerCount; ++c) {
    text += (text.empty() ? "" : " ") + std::to_string(obj.corners[c].position);
    if (obj.corners[c].texcoord) text += "/" + std::to_string(*obj.corners[c].texcoord);
  }
  return text;
}

/// The sections of the polygons in file order.
std::string sectionsOf(const PolygonMesh& obj) {
  std::string text;
  for (const radiosity::MeshPolygon& polygon : obj.polygons) {
    const radiosity::MeshSection& section = obj.sections[polygon.section];
    text += (text.empty() ? "" : ", ") + obj.objects[section.object].name + ":" + section.material;
  }
  return text;
}

}  // namespace

TEST_CASE("parseObj throws InputError with the line of an error", "[obj]") {
  struct Case {
    std::string text;
    int line;
    std::string id;
  };
  const auto [text, line, id] = GENERATE(values<Case>({
      {"v 0 0 x\n", 1, "'x' is not a number"},
      {"v 0 0 1.5.2\n", 1, "'1.5.2' is not a number"},
      {"v 0 0 1e\n", 1, "'1e' is not a number"},
      {"v 0 0 0x10\n", 1, "'0x10' is not a number"},
      {"v 0 0 1,5\n", 1, "'1,5' is not a number"},
      {"v 0 0 +-1\n", 1, "'+-1' is not a number"},
      {"v 0 0 +\n", 1, "'+' is not a number"},
      {"v 0 0 0\n\n# ok\nv 1 nan 0\n", 4, "'nan' is not a finite number"},
      {"v 0 0 0\r\nv 1 -inf 0\r\n", 2, "'-inf' is not a finite number"},
      {"v 0 0 0\rv 1 infinity 0\r", 2, "'infinity' is not a finite number"},
      {"v 0 0 1e999\n", 1, "'1e999' is outside the range"},
      {"v 0 0 -2e18\n", 1, "above 1e18"},
      {"vt 0 -2e18\n", 1, "above 1e18"},
      {"v 0 0\n", 1, "3 coordinates"},
      {"v\n", 1, "3 coordinates"},
      {"v 0 0 # 0\n", 1, "3 coordinates"},
      {"v 0 0 0 1 1\n", 1, "3 coordinates"},
      {"v 0 0 0 1 1 1 1 1\n", 1, "one number too many"},
      {"v 0 0 0 1 1 inf\n", 1, "'inf' is not a finite number"},
      {"vt\n", 1, "at least 1 number"},
      {"vt 0 u\n", 1, "'u' is not a number"},
      {"vt 0 1e400\n", 1, "'1e400' is outside the range"},
      {"vt 0 0 0 0\n", 1, "one number too many"},
      {"vn 0 0\n", 1, "3 numbers"},
      {"vn 0 0 -nan\n", 1, "'-nan' is not a finite number"},
      {triangle + "f 1 2\n", 4, "at least 3 corners"},
      {triangle + "f\n", 4, "at least 3 corners"},
      {triangle + "f 1 2 # 3\n", 4, "at least 3 corners"},
      {triangle + "f 1 2 0\n", 4, "index 0"},
      {triangle + "f 1 2 3\nf 1 2 4\n", 5, "index 4 is out of range: there are 3 vertices"},
      {triangle + "f 1 2 -4\n", 4, "index -4 is out of range: there are 3 vertices above"},
      {triangle + "f 1 2 99999999999\n", 4, "'99999999999' is not an index"},
      {triangle + "f 1 2 3.0\n", 4, "'3.0' is not an index"},
      {triangle + "f 1 2 b\n", 4, "'b' is not an index"},
      {triangle + "f 1 2 /1\n", 4, "'' is not an index"},
      {triangle + "vt 0 0\nf 1/1 2/1 3/2\n", 5, "index 2 is out of range: there are 1 texture coordinates"},
      {triangle + "f 1/-1 2/-1 3/-1\n", 4, "index -1 is out of range: there are 0 texture coordinates"},
      {triangle + "f 1//0 2//0 3//0\n", 4, "index 0"},
      {triangle + "f 1/1/1/1 2 3\n", 4, "'1/1' is not an index"},
  }));
  CAPTURE(text);
  try {
    parseObj(text, "room.obj");
    FAIL("accepted");
  } catch (const raster::InputError& error) {
    CHECK(error.file() == "room.obj");
    CHECK(error.line() == line);
    CHECK_THAT(error.what(), Catch::Contains(id));
  }
}

TEST_CASE("parseObj warns once, with the line, of normals that the file lacks", "[obj]") {
  const auto [text, index, line] = GENERATE(table<std::string, std::string, std::string>({
      {triangle + "vn 0 0 1\nf 1//1 2//1 3//2\nf 3//2 2//1 1//1\n", "normal 2,", "(line 5)"},
      {triangle + "f 1//7 2//3 3//5\nvn 0 0 1\n", "normal 7,", "(line 4)"},
      {triangle + "f 1//1 2//1 3//1\nvn 0 0 1\nvn 0 0 1\nf 1//-3 2//-2 3//-1\nf 1//9 2//1 3//1\n", "normal -3,",
       "(line 7)"},
  }));
  CAPTURE(text);
  const PolygonMesh obj = parseObj(text, "");
  REQUIRE(obj.warnings.size() == 1);
  CHECK_THAT(obj.warnings[0], Catch::Contains(index) && Catch::Contains(line));
  CHECK(cornersOf(obj, 0) == "0 1 2");
  // Indices point forward to the last normal of the file.
  CHECK(parseObj(triangle + "f 1//2 2//1 3//2\nvn 0 0 1\nvn 0 0 1\nf 1//-2 2//-1 3//2\n", "").warnings.empty());
}

TEST_CASE("parseObj rounds numbers to the nearest double", "[obj]") {
  // The compiler rounds its literals correctly; none of these survives a conversion through float or repeated powers of
  // ten.
  const PolygonMesh obj =
      parseObj("v 0.1 123456789.123456789 1e-320\nv +1.5 .5 2.\nv 1E+5 -0 17976931348623157e-1\n", "");
  CHECK(obj.positions[0] == glm::dvec3(0.1, 123456789.123456789, 1e-320));
  CHECK(obj.positions[1] == glm::dvec3(1.5, 0.5, 2));
  CHECK(obj.positions[2] == glm::dvec3(1e5, 0, 17976931348623157e-1));
  CHECK_FALSE(std::signbit(obj.positions[2].y));
}

TEST_CASE("parseObj ignores blanks, comments, line ends and a byte order mark", "[obj]") {
  const auto text = GENERATE(values<std::string>({
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 1\ng wall\nusemtl red\nf 1/1 2/1 3/1\n",
      "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nvt 0.5 1\r\ng wall\r\nusemtl red\r\nf 1/1 2/1 3/1\r\n",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rvt 0.5 1\rg wall\rusemtl red\rf 1/1 2/1 3/1",
      "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 1 0\ng wall\nusemtl red\nf 1/1 2/1 3/1",
      "# v x\n \tv\t0  0 0 # origin\nv 1 0 0 1.0\nv 0 1 0 #1\n\n\nvt 0.5 1 \t\n g  wall \nusemtl\tred # dull\n\tf 1/1 "
      "2/1 3/1 # 4\n",
      "mtllib\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 1\no wall\nusemtl red\ns off\nl 1 2\np 3\nf 1/1/ 2/1/ 3/1/\nunknown "
      "x\n",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 1\nvn 0 0 1\ng wall\nusemtl red\nf 1/1/1 2/1/-1 -1/-1/1\n",
  }));
  CAPTURE(text);
  const PolygonMesh obj = parseObj(text, "");
  CHECK(obj.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(obj.texcoords == std::vector<glm::dvec2>{{0.5, 1}});
  CHECK(obj.polygons.size() == 1);
  CHECK(cornersOf(obj, 0) == "0/0 1/0 2/0");
  CHECK(obj.polygons[0].textured);
  CHECK(sectionsOf(obj) == "wall:red");
}

TEST_CASE("parseObj counts indices from the start, or back from the face, and lets them point forward", "[obj]") {
  const PolygonMesh obj =
      parseObj("f 1 2 3\n" + triangle + "f -3 -2 -1\nvt 0 0\nv 2 2 2\nf -1/-1 1 2\nf 1// 2//1 4\nvn 0 0 1\n", "");
  CHECK(cornersOf(obj, 0) == "0 1 2");
  CHECK(cornersOf(obj, 1) == "0 1 2");
  CHECK(cornersOf(obj, 2) == "3/0 0 1");
  CHECK(cornersOf(obj, 3) == "0 1 3");
  CHECK_FALSE(obj.polygons[2].textured);
  CHECK(obj.polygons[3].line == 9);
}

TEST_CASE("parseObj reads faces with more corners than a byte can count", "[obj]") {
  std::string vertices, face = "f";
  for (int i = 1; i <= 1000; ++i) {
    vertices += "v " + std::to_string(i) + " 0 0\n";
    face += " " + std::to_string(i);
  }
  const PolygonMesh obj = parseObj(vertices + face, "");
  CHECK(obj.polygons.size() == 1);
  CHECK(obj.polygons[0].cornerCount == 1000);
}

TEST_CASE("parseObj reads colours of vertices as sRGB, and names weights", "[obj]") {
  const PolygonMesh obj = parseObj("v 1 2 3\nv 1 2 3 0 0.5 1\nv 1 2 3 1\nv 1 2 3 1 0 0 1\nv 1 2 3 2\n", "");
  CHECK(obj.positions == std::vector<glm::dvec3>(5, {1, 2, 3}));
  const float middle = static_cast<float>(std::pow((0.5 + 0.055) / 1.055, 2.4));
  CHECK(glm::distance(obj.colours[1], glm::vec3(0, middle, 1)) < 1e-6F);
  CHECK((obj.colours[0] == glm::vec3(1) && obj.colours[2] == glm::vec3(1) && obj.colours[4] == glm::vec3(1)));
  CHECK(obj.colours[3] == glm::vec3(1, 0, 0));
  REQUIRE(obj.warnings.size() == 1);
  CHECK(obj.warnings[0] == "a vertex has a fourth coordinate, which is left out (line 5, and perhaps others)");
}

TEST_CASE("parseObj joins lines that end with a backslash, and names the first of them", "[obj]") {
  const std::string vertices = "v 0 0 \\\n0\nv 1\\\r\n0 0\nv 1 1 0\n# C:\\\n";
  const PolygonMesh obj = parseObj(vertices + "f 1 2 \\  \n \\\n3\n", "");
  CHECK(obj.positions.size() == 3);
  REQUIRE(obj.polygons.size() == 1);
  CHECK(obj.polygons[0].line == 7);
  CHECK_THROWS_WITH(parseObj(vertices + "f 1 2 \\\n x\n", "a.obj"), Catch::Contains("a.obj:7: 'x'"));
  CHECK(parseObj(vertices + "f 1 2 3\\", "").polygons.size() == 1);
}

TEST_CASE("parseObj puts faces with the same group and material into one section, wherever they are", "[obj]") {
  struct Case {
    std::string structure, sections;
  };
  const std::string f = "f 1 2 3\n";
  const auto [structure, sections] = GENERATE_COPY(values<Case>({
      {f, "default:"},
      {"usemtl red\n" + f + "g\n" + f, "default:red, default:red"},
      {"g a\n" + f + "g b\n" + f + "g a\n" + f, "a:, b:, a:"},
      {"o a\nusemtl red\n" + f + "usemtl blue\n" + f + "usemtl red\n" + f, "a:red, a:blue, a:red"},
      {"usemtl red\no a\n" + f + "g b c\n" + f + "g\n" + f, "a:red, b c:red, default:red"},
      {"g wall#1\nusemtl Material #25\n" + f, "wall#1:Material #25"},
      {"o two words # and a comment\n" + f, "two words:"},
      {"g empty\nusemtl red\ng a\n" + f, "a:red"},
  }));
  const PolygonMesh obj = parseObj(triangle + structure, "");
  CHECK(sectionsOf(obj) == sections);
  for (std::size_t s = 0; s < obj.sections.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      CHECK((obj.sections[s].object != obj.sections[t].object || obj.sections[s].material != obj.sections[t].material));
    }
  }
}

TEST_CASE("parseObj returns material libraries as they are written", "[obj]") {
  const PolygonMesh obj = parseObj("mtllib a.mtl b.mtl # both\nmtllib\n mtllib my room.mtl \n", "");
  CHECK(obj.materialLibraries == std::vector<std::string>{"a.mtl b.mtl", "my room.mtl"});
}

TEST_CASE("readObj names a file that cannot be read", "[obj]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(radiosity::readObj(folder.path / "none.obj"), Catch::Contains("none.obj: cannot be read"));
  CHECK_THROWS_WITH(radiosity::readObj(folder.path), Catch::Contains(folder.path.string() + ": cannot be read"));
  std::ofstream(folder.path / "empty.obj");
  CHECK(radiosity::readObj(folder.path / "empty.obj").polygons.empty());
}

TEST_CASE("parseObj refuses a NUL byte, which would end a name", "[obj]") {
  using namespace std::string_literals;
  CHECK_THROWS_WITH(parseObj(triangle + "g a\0b\nf 1 2 3\n"s, "nul.obj"),
                    Catch::Contains("nul.obj:4: the line has a NUL byte"));
  CHECK(parseObj(triangle + "# a\0b\nf 1 2 3\n"s, "nul.obj").polygons.size() == 1);
}

TEST_CASE("parseObj quotes at most 200 bytes of a wrong word", "[obj]") {
  const std::string word(100000, 'x');
  for (const std::string& line : {"v 0 0 " + word, "f 1 2 " + word, "v 0 0 0 0 0 0 0 " + std::string(5000, '1')}) {
    try {
      parseObj(triangle + line + "\n", "long.obj");
      FAIL("no error");
    } catch (const raster::InputError& error) {
      CHECK(std::string(error.what()).size() < 300);
      CHECK_THAT(error.what(), Catch::StartsWith("long.obj:4: '"));
    }
  }
}
