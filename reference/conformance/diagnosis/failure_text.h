/// The failure of a vector as text for people who read one message, as in a test or on a page.
#pragma once

#include <string>

#include "reference/conformance/diagnosis/verdict_report.h"

namespace hemitex::reference {

/// How many pixels are errors, what the vector finds, the diagnosis, the first errors, and the derivation of one of
/// them. Requires a report with errors.
std::string failureText(const TestVector& vector, const Report& report);

}  // namespace hemitex::reference
