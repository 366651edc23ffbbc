// Reports as JSON and JUnit XML.
#include "reference/conformance/diagnosis/verdict_report.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/judged_wall.h"

using namespace hemitex;
using reference::Report;
using reference::toText;
using tests::JudgedWall;

TEST_CASE("firstErrors and toJson give counts per face and the first ten errors", "[verdict]") {
  JudgedWall judged;
  for (std::size_t pixel = 8; pixel < 24; ++pixel) judged.found[0].ids[pixel] ^= 1;
  judged.found[1].ids[0] = 0x555555;
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
  CHECK(errors[2].visible->inverseDepth == Approx(1));

  const auto json = nlohmann::json(toJson(Report{verdict, errors, {}}));
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

TEST_CASE("toJson and toJUnit name the diagnosis, or both where two are indistinguishable", "[verdict]") {
  JudgedWall judged;
  judged.found[0].ids[0] = 0;
  const reference::Verdict verdict = judged.verdict();
  const std::vector<reference::Finding> findings{{"depth test off", "", 0.96, "turn it on"},
                                                 {"padded rows", "64 bytes", 1, "set pack & unpack alignment"}};
  const Report named{verdict, {}, findings}, unnamed{verdict, {}, {}};
  const std::string text =
      "either depth test off (96.0 % agreement): turn it on; or padded rows, 64 bytes (100.0 % agreement): set pack ";
  CHECK(toText(findings) == text + "& unpack alignment");

  const auto json = nlohmann::json(toJson(named));
  REQUIRE(json["diagnosis"].size() == 2);
  CHECK(json["diagnosis"][1]["fault"] == "padded rows");
  CHECK(json["diagnosis"][1]["variant"] == "64 bytes");
  CHECK(json["diagnosis"][0]["agreement"] == 0.96);
  CHECK(json["diagnosis"][0]["advice"] == "turn it on");
  CHECK(nlohmann::json(toJson(unnamed))["diagnosis"].empty());

  CHECK(reference::toJUnit({&named, 1}).find("diagnosis: " + text + "&amp; unpack alignment\n</failure>") !=
        std::string::npos);
  CHECK(reference::toJUnit({&unnamed, 1}).find("diagnosis") == std::string::npos);
}

TEST_CASE("toJUnit makes each face a test case that fails where it has errors", "[verdict]") {
  JudgedWall judged;
  judged.found[1].ids[5] = 0;
  const reference::Verdict verdict = judged.verdict();
  const Report report{verdict, firstErrors(judged.vector, verdict), {}};
  const std::string xml = reference::toJUnit({&report, 1});
  CHECK(xml.find("<testsuite name=\"a &lt;wall&gt; &amp; &quot;more&quot;\" tests=\"2\" failures=\"1\">") !=
        std::string::npos);
  CHECK(xml.find("name=\"top\"/>") != std::string::npos);
  CHECK(xml.find("<failure message=\"1 pixels are errors\">pixel 5,4, foreign item ID: expected 266 (draw 0 ") !=
        std::string::npos);
}

TEST_CASE("toJUnit and toJson compare outcomes with their expectations", "[verdict]") {
  using reference::Expectation;
  JudgedWall right, wrong;
  wrong.found[0].ids[0] = 0;
  Report known{wrong.verdict(), {}, {}}, fixed{right.verdict(), {}, {}}, missing{{"gone", {}}, {}, {}};
  known.expected = {"wall", Expectation::Fail, "bug 12"};
  fixed.expected = known.expected;
  missing.isMissing = true;
  CHECK_FALSE(isFailure(known, true));
  CHECK_FALSE(isFailure(fixed, false));
  CHECK(isFailure(fixed, true));
  CHECK(isFailure(missing, false));
  const auto contains = [](const Report& report, bool isStrict, const std::string& text) {
    return reference::toJUnit({&report, 1}, isStrict).find(text) != std::string::npos;
  };
  CHECK(contains(known, true, "failures=\"0\" skipped=\"1\">"));
  CHECK(contains(known, true, "<skipped message=\"1 pixels are errors, expected to fail: bug 12\"></skipped>"));
  CHECK(contains(fixed, false, "failures=\"0\">"));
  CHECK(contains(fixed, true, "<failure message=\"unexpected pass, expected to fail: bug 12\">"));
  CHECK(contains(missing, false, "<failure message=\"missing: the vector was not drawn\">"));

  auto json = nlohmann::json(reference::toJson(std::vector{known, missing}));
  CHECK(json["pass"] == false);
  CHECK(json["vectors"][0]["outcome"] == "errors");
  CHECK(json["vectors"][0]["expected"] == nlohmann::json({{"result", "fail"}, {"reason", "bug 12"}}));
  CHECK(json["vectors"][1]["outcome"] == "missing");
  CHECK(json["vectors"][1]["pass"] == false);
  CHECK(json["vectors"][1]["expected"].is_null());
  missing.expected = {"gone", Expectation::Unsupported, "no carry"};
  CHECK(contains(missing, true, "<skipped message=\"unsupported: no carry\">"));
  json = nlohmann::json(reference::toJson(std::vector{known, missing, fixed}));
  CHECK(json["pass"] == true);
  CHECK(json["vectors"][1]["outcome"] == "not judged");
  CHECK(nlohmann::json(reference::toJson(std::vector{fixed}, true))["pass"] == false);
}

TEST_CASE("commonFault names the fault that most of the failing vectors share", "[verdict]") {
  JudgedWall right, wrong;
  wrong.found[0].ids[0] = 0;
  const reference::Finding dithering{"dithering", "", 0.95, "turn it off"},
      linear{"linear filtering", "", 1, "nearest"};
  const std::vector<Report> reports{{wrong.verdict(), {}, {dithering, linear}},
                                    {right.verdict(), {}, {}},
                                    {wrong.verdict(), {}, {linear}},
                                    {wrong.verdict(), {}, {}}};
  const std::optional<reference::CommonFault> common = reference::commonFault(reports);
  REQUIRE(common);
  CHECK(toText(*common) == "linear filtering, in 2 of 3 vectors with errors: nearest");
  CHECK_FALSE(reference::commonFault({&reports[1], 1}));
  // One of twenty counts, one of twenty-one is chance.
  std::vector<Report> many(20, reports[3]);
  many[7] = reports[2];
  REQUIRE(reference::commonFault(many));
  CHECK(toText(*reference::commonFault(many)) ==
        "perhaps linear filtering, in 1 of 20 vectors with errors (a guess: it does not explain the other vectors): "
        "nearest");
  many.push_back(reports[3]);
  CHECK_FALSE(reference::commonFault(many));

  const auto json = nlohmann::json(reference::toJson(reports));
  CHECK(json["pass"] == false);
  CHECK(json["pixels"]["error"] == 3);
  CHECK(json["vectors"].size() == 4);
  CHECK(json["vectors"][1]["pass"] == true);
  CHECK(json["diagnosis"]["fault"] == "linear filtering");
  CHECK(json["diagnosis"]["vectors"] == 2);
  CHECK(json["diagnosis"]["failures"] == 3);
  CHECK(json["diagnosis"]["weak"] == false);
  CHECK(nlohmann::json(reference::toJson(std::span<const Report>(many).first(20)))["diagnosis"]["weak"] == true);
  const auto passed = nlohmann::json(reference::toJson(std::span(&reports[1], 1)));
  CHECK(passed["pass"] == true);
  CHECK(passed["diagnosis"].is_null());
}

TEST_CASE("commonFault counts the vectors that a named fault explains on a few pixels, too", "[verdict]") {
  JudgedWall wrong;
  wrong.found[0].ids[0] = 0;
  const reference::Finding linear{"linear filtering", "", 1, "nearest"}, dithering{"dithering", "", 1, "off"};
  Report named{wrong.verdict(), {}, {linear}}, other{wrong.verdict(), {}, {dithering}}, few{wrong.verdict(), {}, {}};
  few.explaining = {"padded rows", "linear filtering"};
  const std::vector<Report> reports{other, other, named, few, few, few};
  const std::optional<reference::CommonFault> common = reference::commonFault(reports);
  REQUIRE(common);
  CHECK(toText(*common) == "linear filtering, in 4 of 6 vectors with errors: nearest");
  // A fault that no vector names is no common fault.
  CHECK_FALSE(reference::commonFault(std::vector<Report>{few, few}));
}

TEST_CASE("reportOn judges exactly by the independent evaluator and compares the reference with it", "[verdict]") {
  JudgedWall judged;
  judged.found[0].ids[9] = 0x555555;
  const Report exact = reference::reportOn(judged.vector, judged.found, {}, true);
  Report report = reference::reportOn(judged.vector, judged.found, {});
  CHECK_FALSE(report.reference);
  REQUIRE(exact.reference);
  CHECK(exact.reference->pixels == 96);
  CHECK(exact.reference->differing == 0);
  const auto json = nlohmann::json(toJson(exact));
  CHECK(json["reference"] == nlohmann::json({{"pixels", 96}, {"differing", 0}}));
  CHECK_FALSE(nlohmann::json(toJson(report)).contains("reference"));
  report.reference = exact.reference;
  CHECK(toJson(report) == toJson(exact));
}

TEST_CASE("checkReference adds up the pixels at which the reference differs", "[verdict]") {
  const std::vector<Report> reports{
      {{}, {}, {}, reference::ReferenceCheck{96, 2}}, {{}, {}, {}, reference::ReferenceCheck{10, 1}}, {{}, {}, {}, {}}};
  CHECK(toText(checkReference(reports)) == "differs from the independent evaluator at 3 of 106 pixels");
  CHECK(toText(*reports[0].reference) == "differs from the independent evaluator at 2 of 96 pixels");
  CHECK(toText(reference::ReferenceCheck{96, 0}) == "agrees with the independent evaluator at all 96 pixels");
}
