/// hemitex vector: export, render, check, explain and suite.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/shell.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;
using nlohmann::json;

TEST_CASE("hemitex vector export writes a vector without item IDs, and vector render adds them", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 -o vector");
  CHECK(fs::exists(shell.file("vector/vector.json")));
  CHECK_FALSE(fs::exists(shell.file("vector/top.u32")));
  const std::string faces = shell.output("vector render vector -o vector");
  CHECK(fs::file_size(shell.file("vector/top.u32")) == 8 * 8 * 4);
  CHECK(shell.output("vector render vector -o elsewhere") == faces);
  // A name that is not UTF-8 is repaired.
  shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 --name \xe9 -o latin");
  CHECK(json::parse(readAll(shell.file("latin/vector.json")))["name"] == "\xef\xbf\xbd");
  CHECK(readAll(shell.file("elsewhere/vector.json")) == readAll(shell.file("vector/vector.json")));
}

TEST_CASE("hemitex vector explain derives an item ID from the vertices to the blend", "[cli]") {
  // A triangle from w = 2 to w = 0 is clipped at n = 1/2, a quarter of the way from its far corner. There x/w is 1 and
  // -1, and y/w is 2. In units of 1/256 pixel the sample lies at 1152/4096 of the picture's width and 1152/6144 of the
  // height of the rest: b = (9/32, 17/32, 6/32). 1/w = (9 + 17)/64 + 6/16 = 25/32, and u/w = 9/64 + 9/64 as well as v/w
  // = 9/32 give u = v = 9/25. Behind the triangle is a wall at w = 4.
  using namespace hemitex;
  reference::TestVector vector;
  vector.name = "by-hand";
  raster::DrawList& list = vector.list;
  list.format = {{8, 8}};
  list.indexMaps.push_back(reference::countingMap(4, 4));
  for (raster::ItemId& id : list.indexMaps[0].ids) id *= 0x102;
  reference::addDraw(list, 0x10fa, {}, 0);
  reference::addTriangle(list, {{2, -2, 2}, {-2, -2, 2}, {0, 2, 0}}, {{1, 0}, {0, 0}, {0.5f, 1}});
  reference::addDraw(list, 7);
  reference::addTriangle(list, {{-8, -8, 4}, {-8, 24, 4}, {24, -8, 4}});
  vector.faces.push_back({"front", reference::frontFace(16, 0.5f), "front.u32", {}});
  const Shell shell;
  fs::create_directory(shell.file("vector"));
  reference::writeVector(shell.file("vector"), vector, {});

  CHECK(shell.output("vector explain vector --pixel front,4,4") == R"(pixel 4,4 of front holds 5631: no draw
face: eye (0, 0, 0), x (1, 0, 0), y (0, 1, 0), w (0, 0, 1), near 0.5, resolution 16
triangle: 0
draw: 0
vertices (d = P - eye; x = X.d, y = Y.d, w = W.d in binary32):
  index 0, position (2, -2, 2), from_eye (2, -2, 2), view (2, -2, 2), texcoord (1, 0)
  index 1, position (-2, -2, 2), from_eye (-2, -2, 2), view (-2, -2, 2), texcoord (0, 0)
  index 2, position (0, 2, 0), from_eye (0, 2, 0), view (0, 2, 0), texcoord (0.5, 1)
clip (to w >= n and |x|, |y| <= 8w): cut_by (near, top), piece 0, pieces 2
corners (q = (x/w, y/w), clamped to [-8, 8]; snapped = nearbyint((q + 1) 128 R)):
  view (2, -2, 2), texcoord (1, 0), q (1, -1), snapped (4096, 0)
  view (-2, -2, 2), texcoord (0, 0), q (-1, -1), snapped (0, 0)
  view (-0.5, 1, 0.5), texcoord (0.375, 0.75), q (-1, 2), snapped (0, 6144)
sample (in 1/256 pixel): (1152, 1152)
area (doubled): -25165824
faces_away (area and det(X, Y, W) have the same sign): false
edges (opposite the corners; inside > 0, and = 0 on top and left edges):
  value 7077888, kind left
  value 13369344, kind other
  value 4718592, kind top
weights (b = edge / |area|): (0.28125, 0.53125, 0.1875)
inverse_depth (sum of b/w): 0.78125
u (sum of b u/w over 1/w): 0.36
v (sum of b v/w over 1/w): 0.36
texel (floor of position = (u N, v M), clamped to the map): width 4, height 4, position (1.44, 1.44), column 1, row 1, index 1290
sums (offset + texel, clamped or modulo 2^bits):
  bits 8, offset 250, texel 10, result 255
  bits 8, offset 16, texel 5, result 21
word (the item ID): 5631
runner_up (the next triangle; difference of 1/w): triangle 1, draw 1, inverse_depth 0.25, difference 0.53125
triangles that cover it, nearest first:
triangle,draw,facing,w,u,v,column,row,word
0,0,front,1.28,0.36,0.36,1,1,5631
1,1,front,4,0,0,,,7
)");
  const json derivation = json::parse(shell.output("vector explain vector --pixel front,4,4 --json"))["derivation"];
  CHECK(derivation["clip"] == json::parse(R"({"cut_by": ["near", "top"], "piece": 0, "pieces": 2})"));
  CHECK(derivation["corners"][2]["snapped"] == json({0, 6144}));
  CHECK(derivation["weights"] == json({0.28125, 0.53125, 0.1875}));
  CHECK(derivation["inverse_depth"] == 0.78125);
  CHECK(derivation["texel"]["index"] == 1290);
  CHECK(derivation["runner_up"]["difference"] == 0.53125);
  CHECK(derivation["word"] == 5631);
}

TEST_CASE("hemitex vector export and render write stages beside the vector", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 8 --stages -o vector");
  const json faces = json::parse(readAll(shell.file("vector/stages.json")))["faces"];
  REQUIRE(faces.size() == 5);
  CHECK(fs::file_size(shell.file("vector") / faces[0]["triangles"]) == 8 * 8 * 4);
  CHECK_FALSE(fs::exists(shell.file("vector/top.u32")));
  shell.output("vector render vector --stages -o rendered");
  CHECK(readAll(shell.file("rendered/stages.json")) == readAll(shell.file("vector/stages.json")));
  CHECK(fs::file_size(shell.file("rendered/top.u32")) == 8 * 8 * 4);
  shell.output("vector render vector -o plain");
  CHECK_FALSE(fs::exists(shell.file("plain/stages.json")));
}

TEST_CASE("hemitex vector suite writes folders and a table with the pinned hashes", "[cli]") {
  const Shell shell;
  const json vectors = json::parse(shell.output("vector suite -o suite --json"))["vectors"];
  const std::vector<std::string> pinned = linesOf(readAll(HEMITEX_SUITE_HASHES));
  REQUIRE(vectors.size() == pinned.size() - 1);  // the last line is for the whole suite
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const std::string name = vectors[k]["name"];
    CHECK(vectors[k]["hash"].get<std::string>() + " " + name == pinned[k]);
    const json written = json::parse(readAll(shell.file("suite/" + name + "/vector.json")));
    CHECK(written["name"] == name);
    CHECK(written["catches"] == vectors[k]["catches"]);
    CHECK(fs::exists(shell.file("suite/" + name) / written["faces"][0]["words"]));
  }
  // An existing folder is filled again.
  const std::vector<std::string> table = linesOf(shell.output("vector suite -o suite"));
  CHECK(table.size() == 1 + vectors.size());
  CHECK(table[0] == "name,catches,hash");
}

TEST_CASE("hemitex vector render --device draws a vector on another device if there is one", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0.5,0.5,0.01 --normal 0,0,1 --resolution 16 -o vector");
  CHECK(shell.run("vector render vector --device abacus -o device").exitCode == 2);
  for (const std::string device : {"opengl", "opengl-fixed-function", "opengl-plain", "vulkan"}) {
    INFO(device);
    const std::string draw = "vector render vector --device " + device + " -o " + device;
    const Outcome drawn = shell.run(draw), other = shell.run(draw + " --device-name abacus");
    CHECK(other.exitCode == 2);
    if (drawn.exitCode == 0) {
      CHECK(shell.run("vector check vector --candidate " + device).exitCode == 0);
      CHECK(drawn.err.find("drawn by ") != std::string::npos);
      CHECK(other.err.find("\"abacus\" in its name") != std::string::npos);
    } else
      CHECK((drawn.exitCode == 2 && drawn.err.find(device == "vulkan" ? "Vulkan" : "OpenGL") != std::string::npos));
  }
}

TEST_CASE("hemitex vector check judges a suite of vectors", "[cli]") {
  const Shell shell;
  for (const std::string name : {"near", "far"}) {
    shell.output("vector export room.obj --eye 0.5,0.5," + std::string(name == "near" ? "0.01" : "0.3") +
                 " --normal 0,0,1 --resolution 16 --name " + name + " -o suite/" + name);
    shell.output("vector render suite/" + name + " -o device/" + name);
  }
  const std::string check = "vector check suite --candidate device";
  const std::vector<std::string> right = linesOf(shell.output(check));
  REQUIRE(right.size() == 4);
  CHECK(right[0].substr(0, 13) == "vector,exact,");
  CHECK(right[3] == "all,1536,0,0,0,0,0");
  CHECK(right[1].substr(0, 8) == "far,768,");  // 16 x 16 pixels, and four times 16 x 8

  std::string ids = readAll(shell.file("device/near/top.u32"));
  for (std::size_t byte = 0; byte < ids.size(); byte += 4) std::reverse(&ids[byte], &ids[byte] + 4);
  writeAll(shell.file("device/near/top.u32"), ids);
  const Outcome wrong = shell.run(check + " --json --junit report.xml --diff report.png --minimize small");
  CHECK(wrong.exitCode == 1);
  const json report = json::parse(wrong.out);
  CHECK(report["vectors"][0]["pass"] == true);
  CHECK(report["vectors"][1]["pass"] == false);
  const std::string xml = readAll(shell.file("report.xml"));
  CHECK(xml.find("<testsuite name=\"far\" tests=\"5\" failures=\"0\">") != std::string::npos);
  CHECK(xml.find("<testsuite name=\"near\" tests=\"5\" failures=\"1\">") != std::string::npos);
  CHECK(shell.run("vector check small --candidate small/candidate").exitCode == 1);
  // The result of an earlier failure is replaced.
  CHECK(shell.run(check + " --minimize small").exitCode == 1);
  CHECK(shell.run("vector check small --candidate small/candidate").exitCode == 1);

  fs::remove_all(shell.file("device/far"));
  const Outcome missing = shell.run(check);
  CHECK(missing.exitCode == 1);
  CHECK(missing.out.find("\nmissing: far was not drawn\n") != std::string::npos);
  CHECK(shell.run("vector check suite --candidate nowhere").exitCode == 2);
  fs::create_directory(shell.file("empty"));
  CHECK(shell.run("vector check empty --candidate device").exitCode == 2);
}

TEST_CASE("hemitex vector check --exact judges the reference and the candidate by the independent evaluator", "[cli]") {
  const Shell shell;
  for (const std::string height : {"0.01", "0.3"}) {
    shell.output("vector export room.obj --eye 0.5,0.5," + height + " --normal 0,0,1 --resolution 8 -o suite/" +
                 height);
    shell.output("vector render suite/" + height + " -o device/" + height);
  }
  const std::string one = "vector check suite/0.3 --candidate device/0.3 --exact",
                    all = "vector check suite --candidate device --exact";
  const std::string agrees = "reference: agrees with the independent evaluator at all ";
  CHECK(shell.output(one).find("\n" + agrees + "192 pixels\n") != std::string::npos);
  CHECK(shell.output(all).find("\n" + agrees + "384 pixels\n") != std::string::npos);
  CHECK(json::parse(shell.output(one + " --json"))["reference"] == json({{"pixels", 192}, {"differing", 0}}));
  const json report = json::parse(shell.output(all + " --json"));
  for (const json& vector : report["vectors"]) CHECK(vector["reference"]["differing"] == 0);

  std::string ids = readAll(shell.file("device/0.3/top.u32"));
  ids[3] = static_cast<char>(ids[3] ^ 64);
  writeAll(shell.file("device/0.3/top.u32"), ids);
  const Outcome wrong = shell.run(one + " --minimize small");
  CHECK(wrong.exitCode == 1);
  CHECK(wrong.out.find("error in top: pixel 0,0") != std::string::npos);
  CHECK(wrong.out.find(agrees) != std::string::npos);
  CHECK(shell.run("vector check small --candidate small/candidate --exact").exitCode == 1);
  CHECK(shell.run("vector check suite/0.3 --candidate nowhere --exact").exitCode == 2);
}

TEST_CASE("hemitex vector check names a systematic fault", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0.5,0.5,0.01 --normal 0,0,1 --resolution 16 -o vector");
  shell.output("vector render vector -o device");
  for (const char* face : {"top", "side-right", "side-up", "side-left", "side-down"}) {
    const std::string file = "device/" + std::string(face) + ".u32";
    std::string ids = readAll(shell.file(file));
    for (std::size_t byte = 0; byte < ids.size(); byte += 4) std::reverse(&ids[byte], &ids[byte] + 4);
    writeAll(shell.file(file), ids);
  }
  const Outcome wrong = shell.run("vector check vector --candidate device");
  CHECK(wrong.exitCode == 1);
  CHECK(wrong.out.find("\ndiagnosis: byte order, in item ID files (100.0 % agreement): ") != std::string::npos);
  const json report = json::parse(shell.run("vector check vector --candidate device --json").out);
  REQUIRE(report["diagnosis"].size() == 1);
  CHECK(report["diagnosis"][0]["fault"] == "byte order");
}

TEST_CASE("hemitex vector check --strict-depth names less-or-equal, which the rounding of depths excuses otherwise",
          "[cli]") {
  namespace reference = hemitex::reference;
  const Shell shell;
  shell.output("vector suite -o suite");
  reference::TestVector vector = reference::readVector(shell.file("suite/equal-depths"));
  std::reverse(vector.list.draws.begin(), vector.list.draws.end());  // keeps the last of equal depths
  fs::create_directory(shell.file("device"));
  reference::writeCandidate(shell.file("device"), vector, reference::render(vector));
  const std::string check = "vector check suite/equal-depths --candidate device";
  CHECK(json::parse(shell.output(check + " --json"))["pixels"]["depth"] == 640);
  const Outcome strict = shell.run(check + " --strict-depth");
  CHECK(strict.exitCode == 1);
  CHECK(strict.out.find("\ndiagnosis: equal depths pass the depth test (100.0 % agreement): ") != std::string::npos);
  CHECK(shell.run("vector check suite/equal-depths --candidate suite/equal-depths --strict-depth").exitCode == 0);
}

TEST_CASE("hemitex vector check passes the reference, fails on one wrong item ID, and refuses a short file", "[cli]") {
  const Shell shell;
  shell.output("vector export room.obj --eye 0.5,0.5,0.01 --normal 0,0,1 --resolution 16 -o vector");
  shell.output("vector render vector -o device");
  const std::string check = "vector check vector --candidate device";
  CHECK(json::parse(shell.output(check + " --json"))["pixels"]["error"] == 0);

  std::string ids = readAll(shell.file("device/top.u32"));
  ids[100] = static_cast<char>(ids[100] ^ 1);
  ids[103] = static_cast<char>(ids[103] ^ 64);
  writeAll(shell.file("device/top.u32"), ids);
  const Outcome wrong = shell.run(check + " --json --junit report.xml --diff report.png");
  CHECK(wrong.exitCode == 1);
  const json report = json::parse(wrong.out);
  CHECK(report["pixels"]["error"] == 1);
  CHECK(report["errors"][0]["column"] == 9);  // byte 100 belongs to item ID 25: row 1, column 9
  CHECK(report["errors"][0]["row"] == 1);
  CHECK(readAll(shell.file("report.xml")).find("failures=\"1\"") != std::string::npos);
  CHECK(readAll(shell.file("report.png")).substr(1, 3) == "PNG");

  CHECK(shell.run(check + " --minimize small").exitCode == 1);
  const Outcome small = shell.run("vector check small --candidate small/candidate --json");
  CHECK(small.exitCode == 1);
  CHECK(json::parse(small.out)["pixels"]["error"] == 1);
  CHECK(json::parse(small.out)["errors"][0]["kind"] == report["errors"][0]["kind"]);
  CHECK(fs::file_size(shell.file("small/indices.u32")) <= 2 * 3 * 4);

  const json explained = json::parse(shell.output("vector explain vector --pixel top,9,1 --json"));
  CHECK(explained["word"] == report["errors"][0]["expected"]);
  CHECK(explained["triangles"][0]["word"] == explained["word"]);

  writeAll(shell.file("device/top.u32"), ids.substr(4));
  CHECK(shell.run(check).exitCode == 2);
  writeAll(shell.file("device/top.u32"), ids + "more");
  CHECK(shell.run(check).exitCode == 2);
  CHECK(shell.run("vector check vector --candidate nowhere").exitCode == 2);
  CHECK(shell.run("vector explain vector --pixel top,16,1").exitCode == 2);
  CHECK(shell.run("vector explain vector --pixel top,1").exitCode == 2);
  CHECK(shell.run(check + " --profile room.obj").exitCode == 2);
}
