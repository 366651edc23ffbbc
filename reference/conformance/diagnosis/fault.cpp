#include "reference/conformance/diagnosis/fault.h"

#include <utility>

namespace hemitex::reference {

std::vector<Fault> knownFaults(const TestVector& vector) {
  std::vector<Fault> faults;
  for (const auto& theme :
       {viewFaults, geometryFaults, sampleFaults, textureFaults, blendFaults, memoryFaults, drawFaults})
    for (Fault& fault : theme(vector)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace hemitex::reference
