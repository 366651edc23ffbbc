#include "cli/vector/vector_output.h"

#include <iostream>

#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"

namespace hemitex::cli {

using nlohmann::ordered_json;

void printFaces(const reference::TestVector& vector, const Context& context) {
  const ordered_json faces = listOf(vector.faces, [](const reference::VectorFace& face) -> ordered_json {
    return {{"face", face.name},
            {"width", face.face.scissor.width},
            {"height", face.face.scissor.height},
            {"hash", face.hash}};
  });
  if (context.json)
    std::cout << toText({{"name", vector.name}, {"faces", faces}});
  else
    writeCsv(std::cout, tableOf(faces));
}

void writeVectors(const std::filesystem::path& folder, const std::string& writer, std::size_t count,
                  const std::function<reference::TestVector(std::size_t)>& vectorAt, bool withIds,
                  const Context& context) {
  Staging staging({.place = folder, .writer = writer});
  ordered_json vectors = ordered_json::array();
  for (std::size_t k = 0; k < count; ++k) {
    const reference::TestVector vector = vectorAt(k);
    const auto buffers = withIds ? reference::render(vector) : std::vector<raster::ItemBuffer>();
    std::filesystem::create_directory(staging.folder() / vector.name);
    reference::writeVector(staging.folder() / vector.name, vector, buffers);
    vectors.push_back({{"name", vector.name}, {"catches", vector.catches}});
    if (withIds) vectors.back()["hash"] = reference::idsHash(buffers);
  }
  staging.commit();
  if (context.json)
    std::cout << toText({{"vectors", vectors}});
  else
    writeCsv(std::cout, tableOf(vectors));
}

std::vector<raster::ItemBuffer> drawVector(const reference::TestVector& vector, Device device,
                                           const std::string& name) {
  if (device == Device::Software) return render(vector);
  return render(*makeRenderer(vector.list, device, name), facesOf(vector));
}

void addDevice(Command command, Device& device, std::string& name) {
  const Option option =
      addChoice<Device>(command, "--device", device,
                        {{"software", Device::Software},
                         {"opengl", Device::OpenGl},
                         {"opengl-fixed-function", Device::OpenGlFixedFunction},
                         {"opengl-plain", Device::OpenGlPlain},
                         {"vulkan", Device::Vulkan},
                         {"vulkan-compute", Device::VulkanCompute}},
                        "draw with this renderer; software follows the raster rules exactly (default software)");
  command.addText("--device-name", "NAME", "draw with the first device whose name contains this", name).needs(option);
}

void addStages(Command command, bool& stages) {
  command.addFlag("--stages", stages,
                  "also write the intermediate results between vertices and item IDs (stages.json)");
}

}  // namespace hemitex::cli
