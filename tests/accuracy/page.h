/// docs/accuracy.md: what the extremes look like as a page. Sections are made of what was measured; numbers are rounded
/// so that no last bit of a mathematical library shows.
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

/// What the page says before its first section, and the title line of one.
std::string introduction();
std::string headline(const std::string& title);

/// Sections, each with its headline; one answer (finding) a case.
std::string section(const FormFactorTheme& theme, const std::vector<FormFactorAnswers>& answers);
std::string section(const std::vector<FurnaceCase>& cases, const std::vector<FurnaceFindings>& findings);
std::string section(const std::vector<EmissionCase>& cases, const std::vector<EmissionFindings>& findings);
std::string section(const std::vector<IdCase>& cases);
std::string section(const OneSurfaceFindings& findings);
std::string section(const MillionFindings& findings);
std::string section(const std::vector<LimitCase>& cases);

/// The titles of all sections, as they follow each other, each with what measures it anew and writes it.
struct Section {
  std::string title;
  std::string (*make)();
};
const std::vector<Section>& sections();

}  // namespace hemitex::accuracy
