// What a verdict says: counts, the first errors and their elements, JSON, JUnit XML, the picture.
#include "reference/verdict_report.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/raster_scenes.h"

using namespace hemitex;
using reference::originOf;
using reference::toText;

namespace {

/// Two faces of 8 x 8 and 8 x 4 pixels that look at one wall of 4 x 4 texels; its words are 0x100 + texel.
struct Judged {
  reference::TestVector vector;
  std::vector<raster::ItemBuffer> found;

  Judged() {
    vector.name = "a <wall> & \"more\"";
    raster::DrawList& list = vector.list;
    list.format = {{8, 8, 8}};
    list.indexMaps.push_back(tests::countingMap(4, 4));
    tests::addDraw(list, 0x100, 0x300, 0);
    tests::addTriangle(list, {{-1, -1, 1}, {1, 1, 1}, {1, -1, 1}}, {{0, 0}, {1, 1}, {1, 0}});
    tests::addTriangle(list, {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}, {{0, 0}, {0, 1}, {1, 1}});
    raster::Face face = tests::frontFace(8);
    vector.faces.push_back({"top", face, "top.u32", ""});
    face.scissor = {0, 4, 8, 4};
    vector.faces.push_back({"side", face, "side.u32", ""});
    for (const reference::VectorFace& each : vector.faces) found.push_back(tests::drawOne(list, each.face));
  }

  reference::Verdict verdict() const { return judge(vector, found, {}); }
};

}  // namespace

TEST_CASE("a word is traced back to its draw and texel", "[verdict]") {
  raster::DrawList list = Judged().vector.list;
  tests::addDraw(list, 0x200);
  tests::addDraw(list, 0xff00fe, {}, 0);  // clamps with texels above 1
  CHECK(toText(originOf(list, 0xffffff)) == "background");
  CHECK(toText(originOf(list, 0x100)) == "draw 0 texel 0,0");
  CHECK(toText(originOf(list, 0x10d)) == "draw 0 texel 1,3");
  CHECK(toText(originOf(list, 0x110)) == "no draw");
  CHECK(toText(originOf(list, 0x200)) == "draw 1");
  CHECK(toText(originOf(list, 0x300)) == "back of draw 0");
  CHECK(toText(originOf(list, 0xff00ff)) == "draw 2 texel 1,0");
  CHECK(toText(originOf(list, 0xff0100)) == "no draw");  // a carry that clamped addition cannot make
}

TEST_CASE("the report counts by face and names the first ten errors", "[verdict]") {
  Judged judged;
  for (std::size_t pixel = 8; pixel < 24; ++pixel) judged.found[0].words[pixel] ^= 1;
  judged.found[1].words[0] = 0x555555;
  const reference::Verdict verdict = judged.verdict();
  const auto errors = firstErrors(judged.vector, verdict);
  REQUIRE(errors.size() == 10);
  CHECK(errors[0].column == 0);
  CHECK(errors[0].row == 1);
  // Row 1 of 8 lies in texel row 0, columns 2 and 3 in texel column 1.
  CHECK(toText(errors[2].expectedOrigin) == "draw 0 texel 1,0");
  CHECK(toText(errors[2].foundOrigin) == "draw 0 texel 0,0");
  REQUIRE(errors[2].visible);
  CHECK(errors[2].visible->triangle == 0);  // column 2 is right of row 1 on the diagonal
  CHECK(errors[2].visible->w == Approx(1));

  const auto json = nlohmann::json::parse(toJson(verdict, errors));
  CHECK(json["pass"] == false);
  CHECK(json["pixels"]["error"] == 17);
  CHECK(json["pixels"]["exact"] == 96 - 17);
  CHECK(json["faces"][0]["error"] == 16);
  CHECK(json["faces"][1]["error"] == 1);
  CHECK(json["faces"][1]["height"] == 4);
  CHECK(json["errors"].size() == 10);
  CHECK(json["errors"][2]["texel"] == nlohmann::json({1, 0}));

  const auto last = firstErrors(judged.vector, verdict, 100).back();
  CHECK(last.face == "side");
  CHECK(last.row == 4);
}

TEST_CASE("in JUnit XML each face is a test case that fails where it has errors", "[verdict]") {
  Judged judged;
  judged.found[1].words[5] = 0;
  const reference::Verdict verdict = judged.verdict();
  const std::string xml = toJUnit(verdict, firstErrors(judged.vector, verdict));
  CHECK(xml.find("<testsuite name=\"a &lt;wall&gt; &amp; &quot;more&quot;\" tests=\"2\" failures=\"1\">") !=
        std::string::npos);
  CHECK(xml.find("name=\"top\"/>") != std::string::npos);
  CHECK(xml.find("<failure message=\"1 pixels are errors\">pixel 5,4: expected 266 (draw 0 texel 2,2)") !=
        std::string::npos);
}

TEST_CASE("the picture shows expected, found and verdict beside each other, a row a face", "[verdict]") {
  Judged judged;
  judged.found[0].words[0] = 0xffffff;
  const radiosity::Image picture = toPicture(judged.verdict(), 0xffffff);
  constexpr int gap = 4;
  REQUIRE(picture.width == 3 * 8 + 2 * gap);
  REQUIRE(picture.height == 8 + gap + 4);
  const auto at = [&](int column, int row) {
    return picture.pixels[static_cast<std::size_t>(row * picture.width + column)];
  };
  CHECK(at(0, 0) != glm::dvec3(0.0));
  CHECK(at(12, 0) == glm::dvec3(0.0));      // the background is black
  CHECK(at(24, 0) == glm::dvec3(1, 0, 0));  // an error is red
  CHECK(at(1, 0) == at(13, 0));             // equal words have equal colours
  CHECK(at(0, 12) != at(2, 12));            // different words have others
  CHECK(at(25, 0).x == at(25, 0).y);        // exact is grey
}
