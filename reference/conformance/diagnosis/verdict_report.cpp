#include "reference/conformance/diagnosis/verdict_report.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "reference/base/markup_text.h"
#include "reference/conformance/trace/rational_rasterizer.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const VerdictCounts& counts) {
  Json json;
  for (const auto& [verdict, name] : pixelVerdictNames) json[name] = counts[static_cast<std::size_t>(verdict)];
  return json;
}

Json toJson(const ErrorPixel& error) {
  Json json{{"face", error.face},
            {"column", error.column},
            {"row", error.row},
            {"kind", nameOf(errorKindNames, error.kind)},
            {"expected", error.expected},
            {"found", error.found},
            {"expected_from", toText(error.expectedOrigin)},
            {"found_from", toText(error.foundOrigin)},
            {"triangle", nullptr},
            {"texel", nullptr}};
  if (error.visible) {
    json["triangle"] = error.visible->triangle;
    if (error.visible->texel) json["texel"] = {error.visible->texel->column, error.visible->texel->row};
  }
  return json;
}

Json toJson(const Finding& finding) {
  return {{"fault", finding.fault},
          {"variant", finding.variant},
          {"agreement", finding.agreement},
          {"advice", finding.advice}};
}

Json toJson(const std::optional<ExpectedResult>& expected) {
  if (!expected) return nullptr;
  return {{"result", nameOf(expectationNames, expected->expectation)}, {"reason", expected->reason}};
}

Json toJson(const DeviceFailure& device) {
  const ProcessResult& process = device.process;
  Json json{{"failure", nameOf(deviceFaultNames, device.fault)},
            {"message", device.message},
            {"exit_code", nullptr},
            {"signal", nullptr},
            {"stderr", process.lastLines}};
  if (process.signal != 0)
    json["signal"] = process.signal;
  else
    json["exit_code"] = process.exitCode;
  return json;
}

Json toJson(const Repetition& repetition) {
  constexpr std::size_t shown = 10;
  Json json{{"runs", repetition.runs},
            {"answers", repetition.answers},
            {"changing_pixels", repetition.pixels.size()},
            {"pixels", Json::array()}};
  for (std::size_t k = 0; k < std::min(shown, repetition.pixels.size()); ++k) {
    const ChangingPixel& pixel = repetition.pixels[k];
    json["pixels"].push_back(
        {{"face", pixel.face}, {"column", pixel.column}, {"row", pixel.row}, {"runs", pixel.runs}});
  }
  return json;
}

ReferenceCheck compareReference(std::span<const raster::ItemBuffer> drawn,
                                std::span<const raster::ItemBuffer> expected) {
  ReferenceCheck check;
  for (std::size_t f = 0; f < drawn.size(); ++f)
    for (std::size_t pixel = 0; pixel < drawn[f].ids.size(); ++pixel, ++check.pixels)
      check.differing += drawn[f].ids[pixel] != expected[f].ids[pixel];
  return check;
}

// --- JUnit XML ---

struct TestCase {
  std::string name;
  std::string result = {};   ///< `failure` or `skipped`; empty for a pass
  std::string message = {};  ///< of the result
  std::string text = {};     ///< lines below the message
};

/// A failure, or a skipped test case where it is expected.
TestCase failing(const Report& report, const std::string& name, const std::string& message, const std::string& text) {
  if (report.expected) return {name, "skipped", message + ", " + toText(*report.expected)};
  return {name, "failure", message, text};
}

TestCase caseOf(const Report& report, const FaceVerdict& face) {
  const std::uint64_t wrong = countVerdicts(face)[static_cast<std::size_t>(PixelVerdict::Error)];
  if (wrong == 0) return {face.name};
  std::string text = report.findings.empty() ? "" : "diagnosis: " + toText(report.findings) + '\n';
  for (const ErrorPixel& error : report.errors)
    if (error.face == face.name) text += toText(error) + '\n';
  return failing(report, face.name, std::to_string(wrong) + " pixels are errors", text);
}

TestCase caseOf(const Report& report, const DeviceFailure& device) {
  std::string text;
  for (const std::string& line : device.process.lastLines) text += line + '\n';
  return failing(report, "all faces", nameOf(deviceFaultNames, device.fault) + ": " + device.message, text);
}

std::vector<TestCase> casesOf(const Report& report, bool isStrict) {
  const Outcome outcome = outcomeOf(report);
  if (outcome == Outcome::NotJudged) return {{"all faces", "skipped", toText(*report.expected)}};
  if (outcome == Outcome::Missing) return {{"all faces", "failure", "missing: the vector was not drawn"}};
  if (report.device) return {caseOf(report, *report.device)};
  std::vector<TestCase> cases;
  for (const FaceVerdict& face : report.verdict.faces) cases.push_back(caseOf(report, face));
  if (outcome == Outcome::NotDeterministic)
    cases.push_back(
        {"all runs", report.expected ? "skipped" : "failure", "not deterministic: " + toText(*report.repetition)});
  if (isStrict && agreementOf(report) == Agreement::UnexpectedPass)
    cases.push_back({"expectation", "failure", "unexpected pass, " + toText(*report.expected)});
  return cases;
}

std::string xmlOf(const std::string& vector, const TestCase& test) {
  const std::string start =
      "    <testcase classname=\"" + markupText(vector) + "\" name=\"" + markupText(test.name) + "\"";
  if (test.result.empty()) return start + "/>\n";
  return start + ">\n      <" + test.result + " message=\"" + markupText(test.message) + "\">" +
         markupText(test.text, true) + "</" + test.result + ">\n    </testcase>\n";
}

/// The test suite of one vector.
std::string testSuite(const Report& report, bool isStrict) {
  const std::vector<TestCase> cases = casesOf(report, isStrict);
  const auto count = [&](const std::string& result) {
    return std::to_string(
        std::count_if(cases.begin(), cases.end(), [&](const TestCase& test) { return test.result == result; }));
  };
  std::string text;
  for (const TestCase& test : cases) text += xmlOf(report.verdict.vector, test);
  const std::string skipped = count("skipped") == "0" ? "" : " skipped=\"" + count("skipped") + "\"";
  return "  <testsuite name=\"" + markupText(report.verdict.vector) + "\" tests=\"" + std::to_string(cases.size()) +
         "\" failures=\"" + count("failure") + "\"" + skipped + ">\n" + text + "  </testsuite>\n";
}

bool isExplaining(const Report& report, const std::string& fault) {
  return std::find(report.explaining.begin(), report.explaining.end(), fault) != report.explaining.end();
}

/// The number of vectors with errors.
std::size_t failuresOf(std::span<const Report> reports) {
  return static_cast<std::size_t>(
      std::count_if(reports.begin(), reports.end(), [](const Report& report) { return hasErrors(report.verdict); }));
}

}  // namespace

Report reportOn(const TestVector& vector, std::span<const raster::ItemBuffer> found, const DeviceProfile& profile,
                bool isExact) {
  const std::vector<raster::ItemBuffer> drawn = render(vector);
  std::vector<raster::ItemBuffer> expected;
  for (const VectorFace& face : vector.faces)
    if (isExact) expected.push_back(evaluateRules(sourceOf(vector), face.face));
  Report report{judge(vector, isExact ? expected : drawn, found, profile), {}, {}};
  report.errors = firstErrors(vector, report.verdict);
  Diagnosis diagnosis = diagnoseAll(vector, report.verdict);
  report.findings = std::move(diagnosis.findings);
  report.explaining = std::move(diagnosis.explaining);
  if (isExact) report.reference = compareReference(drawn, expected);
  return report;
}

Outcome outcomeOf(const Report& report) {
  if (report.expected && report.expected->expectation == Expectation::Unsupported) return Outcome::NotJudged;
  if (report.isMissing) return Outcome::Missing;
  if (report.device) return Outcome::DeviceFailed;
  if (report.repetition && !report.repetition->isDeterministic()) return Outcome::NotDeterministic;
  return hasErrors(report.verdict) ? Outcome::Errors : Outcome::Pass;
}

Agreement agreementOf(const Report& report) { return compare(outcomeOf(report), report.expected); }

bool isFailure(const Report& report, bool isStrict) {
  const Agreement agreement = agreementOf(report);
  return agreement == Agreement::UnexpectedFailure || (isStrict && agreement == Agreement::UnexpectedPass);
}

ReferenceCheck checkReference(std::span<const Report> reports) {
  ReferenceCheck sum;
  for (const Report& report : reports) {
    const ReferenceCheck check = report.reference.value_or(ReferenceCheck{});
    sum.pixels += check.pixels;
    sum.differing += check.differing;
  }
  return sum;
}

std::string toText(const ReferenceCheck& check) {
  const std::string pixels = std::to_string(check.pixels) + " pixels";
  if (check.differing == 0) return "agrees with the independent evaluator at all " + pixels;
  return "differs from the independent evaluator at " + std::to_string(check.differing) + " of " + pixels;
}

VerdictCounts countVerdicts(std::span<const Report> reports) {
  VerdictCounts sums{};
  for (const Report& report : reports) {
    const VerdictCounts counts = countVerdicts(report.verdict);
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += counts[k];
  }
  return sums;
}

std::optional<CommonFault> commonFault(std::span<const Report> reports) {
  std::optional<CommonFault> best;
  std::set<std::string> known;
  for (const Report& report : reports)
    for (const Finding& finding : report.findings) {
      if (!known.insert(finding.fault).second) continue;
      const auto isNamedIn = [&](const Report& other) {
        return isExplaining(other, finding.fault) ||
               std::any_of(other.findings.begin(), other.findings.end(),
                           [&](const Finding& found) { return found.fault == finding.fault; });
      };
      const auto vectors = static_cast<std::size_t>(std::count_if(reports.begin(), reports.end(), isNamedIn));
      if (!best || vectors > best->vectors)
        best = {.finding = finding, .vectors = vectors, .failures = failuresOf(reports)};
    }
  return best && 20 * best->vectors >= best->failures ? best : std::nullopt;
}

bool isWeak(const CommonFault& common) { return 2 * common.vectors < common.failures; }

std::string toText(const CommonFault& common) {
  return (isWeak(common) ? "perhaps " : "") + common.finding.fault + ", in " + std::to_string(common.vectors) + " of " +
         std::to_string(common.failures) + " vectors with errors" +
         (isWeak(common) ? " (a guess: it does not explain the other vectors): " : ": ") + common.finding.advice;
}

namespace {

std::size_t pixelsOf(const Report& report) {
  std::size_t pixels = 0;
  for (const FaceVerdict& face : report.verdict.faces) pixels += face.pixels.size();
  return pixels;
}

/// The reports with errors that a fault does not explain, those of small vectors first.
std::vector<std::size_t> unexplained(std::span<const Report> reports, std::span<const TestVector* const> vectors,
                                     const std::string& fault) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < reports.size(); ++k)
    if (hasErrors(reports[k].verdict) && !isExplaining(reports[k], fault)) places.push_back(k);
  const auto costOf = [&](std::size_t k) { return pixelsOf(reports[k]) + vectors[k]->list.indices.size(); };
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return costOf(a) < costOf(b); });
  return places;
}

using Names = std::array<std::string, 2>;

Names namesOf(const PairFinding& pair) {
  Names names{pair[0].fault, pair[1].fault};
  std::sort(names.begin(), names.end());
  return names;
}

/// Pairs, the ones first that the first vectors without an explanation name most often.
std::vector<PairFinding> likelyPairs(std::span<const Report> reports, std::span<const TestVector* const> vectors,
                                     std::span<const std::size_t> places) {
  constexpr std::size_t maxSeeds = 4, maxPairs = 6;
  std::vector<PairFinding> pairs;
  std::map<Names, std::size_t> votes;
  for (const std::size_t k : places.first(std::min(places.size(), maxSeeds)))
    for (const PairFinding& pair :
         reports[k].findings.empty() ? diagnosePairs(*vectors[k], reports[k].verdict) : std::vector<PairFinding>{})
      if (++votes[namesOf(pair)] == 1) pairs.push_back(pair);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const PairFinding& a, const PairFinding& b) { return votes[namesOf(a)] > votes[namesOf(b)]; });
  pairs.resize(std::min(pairs.size(), maxPairs));
  return pairs;
}

}  // namespace

std::optional<CommonPair> commonPair(std::span<const Report> reports, std::span<const TestVector* const> vectors) {
  const std::size_t failures = failuresOf(reports);
  const std::optional<CommonFault> single = commonFault(reports);
  const std::size_t alone = single ? single->vectors : 0;
  const auto places = unexplained(reports, vectors, single ? single->finding.fault : "");
  std::vector<PairFinding> pairs = likelyPairs(reports, vectors, places);
  if (single) {  // and the one that explains most of what it leaves
    std::vector<Report> rest;
    for (const std::size_t k : places) rest.push_back(reports[k]);
    if (const auto other = commonFault(rest)) pairs.push_back({single->finding, other->finding});
  }
  CommonPair best;
  for (const PairFinding& pair : pairs) {
    const Names names = namesOf(pair);
    const auto explains = [&](std::size_t k) {
      return isExplaining(reports[k], names[0]) || isExplaining(reports[k], names[1]) ||
             !diagnosePairs(*vectors[k], reports[k].verdict, names).empty();
    };
    // Until it cannot explain more than the best one.
    std::size_t count = failures;
    for (std::size_t k = 0; k < reports.size() && count > best.vectors; ++k)
      count -= hasErrors(reports[k].verdict) && !explains(k);
    if (count > best.vectors) best = {pair, count, failures};
  }
  const std::size_t more = best.vectors - std::min(best.vectors, alone);
  if (more < std::min<std::size_t>(3, failures) || 2 * more <= failures - alone) return {};
  return best;
}

std::string toText(const CommonPair& pair) {
  const bool isGuess = 2 * pair.vectors < pair.failures || pair.failures == 1;
  return (isGuess ? "perhaps " : "") + pair.findings[0].fault + " and " + pair.findings[1].fault + ", in " +
         std::to_string(pair.vectors) + " of " + std::to_string(pair.failures) + " vectors with errors" +
         (isGuess ? " (a guess): " : ": ") + pair.findings[0].advice + "; and: " + pair.findings[1].advice;
}

Json toJson(const CommonPair& pair) {
  return {{"findings", {toJson(pair.findings[0]), toJson(pair.findings[1])}},
          {"vectors", pair.vectors},
          {"failures", pair.failures}};
}

void nameStaleFrames(std::span<Report> reports) {
  const auto idsOf = [](const Report& report, raster::ItemBuffer FaceVerdict::*buffer) {
    std::vector<raster::ItemId> ids;
    for (const FaceVerdict& face : report.verdict.faces)
      ids.insert(ids.end(), (face.*buffer).ids.begin(), (face.*buffer).ids.end());
    return ids;
  };
  for (std::size_t k = 1; k < reports.size(); ++k) {
    if (!hasErrors(reports[k].verdict)) continue;
    const std::vector<raster::ItemId> found = idsOf(reports[k], &FaceVerdict::found);
    for (std::size_t j = k; j-- > 0;) {
      const std::vector<raster::ItemId> before = idsOf(reports[j], &FaceVerdict::expected);
      if (before.size() < found.size() || !std::equal(found.begin(), found.end(), before.begin())) continue;
      const Finding stale{"stale frame", "of " + reports[j].verdict.vector, 1,
                          "wait for the device before the target is read, and read what was drawn last"};
      if (reports[k].findings.empty()) reports[k].findings.push_back(stale);
      reports[k].explaining.push_back(stale.fault);
      break;
    }
  }
}

Json toJson(const Report& report) {
  const Verdict& verdict = report.verdict;
  const Outcome outcome = outcomeOf(report);
  Json json{{"vector", verdict.vector}, {"pass", outcome == Outcome::Pass}, {"pixels", toJson(countVerdicts(verdict))}};
  json["faces"] = Json::array();
  for (const FaceVerdict& face : verdict.faces) {
    Json entry{{"name", face.name}, {"width", face.scissor.width}, {"height", face.scissor.height}};
    entry.update(toJson(countVerdicts(face)));
    json["faces"].push_back(entry);
  }
  json["errors"] = Json::array();
  for (const ErrorPixel& error : report.errors) json["errors"].push_back(toJson(error));
  json["diagnosis"] = Json::array();
  for (const Finding& finding : report.findings) json["diagnosis"].push_back(toJson(finding));
  if (const auto& check = report.reference)
    json["reference"] = {{"pixels", check->pixels}, {"differing", check->differing}};
  json["outcome"] = nameOf(outcomeNames, outcome);
  json["expected"] = toJson(report.expected);
  if (report.device) json["device"] = toJson(*report.device);
  if (report.repetition) json["repetition"] = toJson(*report.repetition);
  return json;
}

Json toJson(std::span<const Report> reports, bool isStrict) {
  Json vectors = Json::array();
  for (const Report& report : reports) vectors.push_back(toJson(report));
  const VerdictCounts sums = countVerdicts(reports);
  Json diagnosis;
  if (const std::optional<CommonFault> common = commonFault(reports)) {
    diagnosis = toJson(common->finding);
    diagnosis.update({{"vectors", common->vectors}, {"failures", common->failures}, {"weak", isWeak(*common)}});
  }
  const bool pass =
      std::none_of(reports.begin(), reports.end(), [=](const Report& report) { return isFailure(report, isStrict); });
  return {{"pass", pass}, {"pixels", toJson(sums)}, {"vectors", vectors}, {"diagnosis", diagnosis}};
}

std::string toJUnit(std::span<const Report> reports, bool isStrict) {
  std::string suites;
  for (const Report& report : reports) suites += testSuite(report, isStrict);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}  // namespace hemitex::reference
