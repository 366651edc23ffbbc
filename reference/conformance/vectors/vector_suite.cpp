#include "reference/conformance/vectors/vector_suite.h"

#include <utility>

#include "raster/software/software_renderer.h"

namespace hemitex::reference {

TestVector makeVector(std::string name, std::string catches, raster::DrawList list, std::vector<raster::Face> faces) {
  TestVector vector;
  vector.name = std::move(name);
  vector.catches = std::move(catches);
  vector.list = std::move(list);
  for (const raster::Face& face : faces) {
    const std::string faceName = faces.size() == 1 ? "front" : "face-" + std::to_string(vector.faces.size());
    vector.faces.push_back({faceName, face, faceName + ".u32", {}});
  }
  return vector;
}

std::vector<TestVector> vectorSuite() {
  std::vector<TestVector> suite;
  for (const auto& theme : {meshVectors, coverageVectors, depthVectors, texelVectors, idVectors, viewVectors})
    for (TestVector& vector : theme()) suite.push_back(std::move(vector));
  return suite;
}

std::vector<raster::ItemBuffer> render(const TestVector& vector) {
  return render(raster::SoftwareRenderer(vector.list), facesOf(vector));
}

std::string idsHash(std::span<const raster::ItemBuffer> buffers) {
  std::vector<raster::ItemId> ids;
  for (const raster::ItemBuffer& buffer : buffers) ids.insert(ids.end(), buffer.ids.begin(), buffer.ids.end());
  return idsHash(ids);
}

}  // namespace hemitex::reference
