#include "reference/conformance/diagnosis/failure_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reference/conformance/verdict/derivation_text.h"
#include "reference/conformance/verdict/explanation.h"

namespace hemitex::reference {
namespace {

/// Of the first error that a triangle should cover, else of the first one.
std::string derivationOf(const TestVector& vector, const std::vector<ErrorPixel>& errors) {
  const auto covered =
      std::find_if(errors.begin(), errors.end(), [](const ErrorPixel& error) { return error.visible.has_value(); });
  const ErrorPixel& error = covered == errors.end() ? errors.front() : *covered;
  const auto face = std::find_if(vector.faces.begin(), vector.faces.end(),
                                 [&](const VectorFace& candidate) { return candidate.name == error.face; });
  return derivationText(explanation(vector, *face, error.column, error.row), face->face);
}

}  // namespace

std::string failureText(const TestVector& vector, const Report& report) {
  const VerdictCounts counts = countVerdicts(report.verdict);
  std::string text = std::to_string(counts[static_cast<std::size_t>(PixelVerdict::Error)]) + " pixels of " +
                     vector.name + " are errors\n";
  if (!vector.catches.empty()) text += "the vector finds: " + vector.catches + '\n';
  if (!report.findings.empty()) text += "diagnosis: " + toText(report.findings) + '\n';
  for (const ErrorPixel& error : report.errors) text += "error in " + error.face + ": " + toText(error) + '\n';
  return text + derivationOf(vector, report.errors);
}

}  // namespace hemitex::reference
