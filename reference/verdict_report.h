/// What a verdict says to machines: JSON, and JUnit XML for build servers.
#pragma once

#include <string>
#include <vector>

#include "reference/diagnosis.h"
#include "reference/error_pixel.h"

namespace hemitex::reference {

/// A JSON object: `vector`, `pass`, `pixels` (a count for each verdict's name), `faces` (the same with `name`, `width`
/// and `height`), `errors` with `face`, `column`, `row`, `kind`, `expected`, `found`, `expected_from`,
/// `found_from`, `triangle` and `texel` (null where there is none), and `diagnosis`, a list with `fault`, `variant`,
/// `agreement` and `advice`: empty where no fault is known, of several where they cannot be told apart.
std::string toJson(const Verdict& verdict, const std::vector<ErrorPixel>& errors, const std::vector<Finding>& findings);

/// JUnit XML: the vector is a test suite, each face a test case that fails where it has errors and names the diagnosis.
std::string toJUnit(const Verdict& verdict, const std::vector<ErrorPixel>& errors,
                    const std::vector<Finding>& findings);

}  // namespace hemitex::reference
