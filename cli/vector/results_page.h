/// The results of a suite as one HTML page that needs no other file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reference/conformance/diagnosis/verdict_report.h"

namespace hemitex::cli {

struct ShownResult {
  const reference::TestVector& vector;
  const reference::Report& report;
  std::string remark;  ///< shown where no pixel is an error; may be empty
};

struct ResultsPage {
  std::string suite;      ///< its name
  std::string diagnosis;  ///< of all vectors; may be empty
  std::vector<ShownResult> results;
};

/// A table of all results. Below it, each vector with errors has its pictures (verdict_picture.h) and its failureText,
/// and other vectors have their remarks. `scratch` is a folder for temporary files, which are removed.
std::string toHtml(const ResultsPage& page, const std::filesystem::path& scratch);

}  // namespace hemitex::cli
