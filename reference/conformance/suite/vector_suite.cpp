#include "reference/conformance/suite/vector_suite.h"

#include <utility>

namespace hemitex::reference {

std::vector<TestVector> vectorSuite() {
  std::vector<TestVector> suite;
  for (const SuiteTheme& theme : suiteThemes)
    for (TestVector& vector : theme.vectors()) suite.push_back(std::move(vector));
  return suite;
}

}  // namespace hemitex::reference
