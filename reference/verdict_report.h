/// What a verdict says to machines: JSON, and JUnit XML for build servers.
#pragma once

#include <string>
#include <vector>

#include "reference/error_pixel.h"

namespace hemitex::reference {

/// A JSON object: `vector`, `pass`, `pixels` (a count for each verdict's name), `faces` (the same with `name`, `width`
/// and `height`), and `errors` with `face`, `column`, `row`, `kind`, `expected`, `found`, `expected_from`,
/// `found_from`, `triangle` and `texel` (null where there is none).
std::string toJson(const Verdict& verdict, const std::vector<ErrorPixel>& errors);

/// JUnit XML: the vector is a test suite, each face a test case that fails where it has errors.
std::string toJUnit(const Verdict& verdict, const std::vector<ErrorPixel>& errors);

}  // namespace hemitex::reference
