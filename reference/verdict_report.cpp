#include "reference/verdict_report.h"

#include <nlohmann/json.hpp>

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const VerdictCounts& counts) {
  Json json;
  for (std::size_t k = 0; k < pixelVerdicts; ++k) json[nameOf(static_cast<PixelVerdict>(k))] = counts[k];
  return json;
}

Json toJson(const ErrorPixel& error) {
  Json json{{"face", error.face},
            {"column", error.column},
            {"row", error.row},
            {"kind", nameOf(error.kind)},
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

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) < 0x20)  // XML 1.0 has no way to write control characters
      result += ' ';
    else
      result += c;
  }
  return result;
}

}  // namespace

std::string toJson(const Verdict& verdict, const std::vector<ErrorPixel>& errors,
                   const std::vector<Finding>& findings) {
  Json json{{"vector", verdict.vector}, {"pass", !hasErrors(verdict)}, {"pixels", toJson(countVerdicts(verdict))}};
  json["faces"] = Json::array();
  for (const FaceVerdict& face : verdict.faces) {
    Json entry{{"name", face.name}, {"width", face.scissor.width}, {"height", face.scissor.height}};
    entry.update(toJson(countVerdicts(face)));
    json["faces"].push_back(entry);
  }
  json["errors"] = Json::array();
  for (const ErrorPixel& error : errors) json["errors"].push_back(toJson(error));
  json["diagnosis"] = Json::array();
  for (const Finding& finding : findings) json["diagnosis"].push_back(toJson(finding));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string toJUnit(const Verdict& verdict, const std::vector<ErrorPixel>& errors,
                    const std::vector<Finding>& findings) {
  const std::string diagnosis = findings.empty() ? "" : escaped("diagnosis: " + toText(findings)) + '\n';
  std::string cases;
  int failures = 0;
  for (const FaceVerdict& face : verdict.faces) {
    const std::uint64_t wrong = countVerdicts(face)[static_cast<std::size_t>(PixelVerdict::Error)];
    cases += "  <testcase classname=\"" + escaped(verdict.vector) + "\" name=\"" + escaped(face.name) + "\"";
    if (wrong == 0) {
      cases += "/>\n";
      continue;
    }
    ++failures;
    cases += ">\n    <failure message=\"" + std::to_string(wrong) + " pixels are errors\">" + diagnosis;
    for (const ErrorPixel& error : errors)
      if (error.face == face.name) cases += escaped(toText(error)) + '\n';
    cases += "</failure>\n  </testcase>\n";
  }
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"" + escaped(verdict.vector) + "\" tests=\"" +
         std::to_string(verdict.faces.size()) + "\" failures=\"" + std::to_string(failures) + "\">\n" + cases +
         "</testsuite>\n";
}

}  // namespace hemitex::reference
