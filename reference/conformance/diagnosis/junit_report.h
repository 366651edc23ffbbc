/// JUnit XML of verdicts, for build servers.
#pragma once

#include <span>
#include <string>

#include "reference/conformance/diagnosis/verdict_report.h"

namespace hemitex::reference {

/// Each vector is a test suite, each face a test case. A face with errors fails and names the diagnosis; it counts as
/// skipped where the errors are expected. A vector without verdicts is one test case: it fails when it is missing or
/// when the program of the device failed, and counts as skipped when it is unsupported. With `isStrict` an unexpected
/// pass is one more test case, which fails.
std::string toJUnit(std::span<const Report> reports, bool isStrict = false);

}  // namespace hemitex::reference
