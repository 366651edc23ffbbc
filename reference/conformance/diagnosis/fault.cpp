#include "reference/conformance/diagnosis/fault.h"

#include <utility>

namespace hemitex::reference {

Variant turnedInMirroredViews(const std::string& name) {
  return {name, withStage(&StagedDevice::facing, [](Facing side, const raster::Face& view) {
            return raster::determinant(view) < 0 ? otherSide(side) : side;
          })};
}

StagedDevice withIds(const IdChange& change) {
  return withReadBack([=](const raster::Face&, raster::ItemBuffer& buffer) {
    for (raster::ItemId& id : buffer.ids) id = change(id);
  });
}

std::vector<Fault> knownFaults(const TestVector& vector) {
  std::vector<Fault> faults;
  for (const auto& theme :
       {viewFaults, geometryFaults, sampleFaults, textureFaults, blendFaults, memoryFaults, drawFaults, assemblyFaults})
    for (Fault& fault : theme(vector)) faults.push_back(std::move(fault));
  return faults;
}

}  // namespace hemitex::reference
