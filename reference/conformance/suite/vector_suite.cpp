#include "reference/conformance/suite/vector_suite.h"

#include <utility>

namespace hemitex::reference {

std::vector<TestVector> vectorSuite() {
  std::vector<TestVector> suite;
  for (const auto& theme : {meshVectors, coverageVectors, depthVectors, texelVectors, idVectors, viewVectors})
    for (TestVector& vector : theme()) suite.push_back(std::move(vector));
  return suite;
}

}  // namespace hemitex::reference
