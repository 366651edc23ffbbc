/// docs/accuracy.md: formats measurements as sections of the page. Numbers are rounded so that differences of
/// mathematical libraries in the last bits do not show.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/accuracy/form_factor_cases.h"
#include "tests/accuracy/id_cases.h"
#include "tests/accuracy/limit_cases.h"
#include "tests/accuracy/numbers.h"
#include "tests/accuracy/size_cases.h"
#include "tests/accuracy/solution_cases.h"

namespace hemitex::accuracy {

/// The text before the first section, and the title line of a section.
std::string introduction();
std::string headline(const std::string& title);

/// Sections with their headlines; one answer or finding per case.
std::string section(const FormFactorTheme& theme, const std::vector<FormFactorAnswers>& answers);
std::string section(const std::vector<FurnaceCase>& cases, const std::vector<FurnaceFindings>& findings);
std::string section(const std::vector<EmissionCase>& cases, const std::vector<EmissionFindings>& findings);
std::string section(const std::vector<IdCase>& cases);
std::string section(const OneSurfaceFindings& findings);
std::string section(const MillionFindings& findings);
std::string section(const std::vector<LimitCase>& cases);
/// Measured by hand (tests/benchmarks/error_bound_benchmark.cpp).
std::string errorBoundSection();

/// The titles of all sections in order, with functions that measure and format them.
struct Section {
  std::string title;
  std::string (*make)();
};
const std::vector<Section>& sections();

}  // namespace hemitex::accuracy
