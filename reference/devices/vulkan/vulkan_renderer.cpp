#include "reference/devices/vulkan/vulkan_renderer.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "raster/base/parallel.h"
#include "reference/devices/passed_samples.h"
#include "reference/devices/vulkan/face_drawing.h"
#include "reference/devices/vulkan/vulkan_sums.h"

namespace hemitex::reference {
namespace {

using raster::Face;
using raster::ItemId;
using Layout = vk::ImageLayout;

std::size_t bytesOf(const Face& face) {
  return sizeof(ItemId) * static_cast<std::size_t>(face.scissor.width) * static_cast<std::size_t>(face.scissor.height);
}

class VulkanRenderer final : public raster::ItemBufferRenderer {
 public:
  VulkanRenderer(const raster::DrawList& list, VulkanPath path, const std::string& name)
      : drawing_(makeFaceDrawing(list, path, name)), commands_(makeCommands(drawing_)) {}

  void draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;
  std::unique_ptr<raster::PixelSums> makeSums(const std::function<raster::SlotTable()>& table) override {
    return makeVulkanSums(drawing_, table);
  }

 private:
  void makeRoom(std::span<const Face> faces);
  void drawAtOnce(const DrawnView& view, raster::ItemBuffer* buffers);

  FaceDrawing drawing_;
  vk::raii::CommandBuffer commands_;
  std::optional<Canvas> canvas_;
  std::optional<VulkanBuffer> output_;  ///< the item IDs of faces, one after the other
  std::size_t outputSize_ = 0;
};

/// Enlarges the canvas and the output where the faces need it.
void VulkanRenderer::makeRoom(std::span<const Face> faces) {
  const vk::Extent2D size = sizeOf(faces);
  if (!canvas_ || canvas_->targets.size.width < size.width || canvas_->targets.size.height < size.height ||
      canvas_->targets.layers < faces.size()) {
    canvas_.reset();
    canvas_ = makeCanvas(drawing_, size, faces.size(), 1);
  }
  std::size_t outputSize = 0;
  for (const Face& face : faces) outputSize += bytesOf(face);
  if (outputSize <= outputSize_) return;
  output_ = makeBuffer(drawing_.context, outputSize, BufferUse::Output);
  outputSize_ = outputSize;
}

/// Draws faces into layers, then copies their item IDs to the output, row 0 first and without padding.
void VulkanRenderer::drawAtOnce(const DrawnView& view, raster::ItemBuffer* buffers) {
  const std::span<const Face> faces = view.faces;
  makeRoom(faces);
  commands_.begin(vk::CommandBufferBeginInfo{.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
  record(commands_, drawing_, *canvas_, {&view, 1}, Layout::eTransferSrcOptimal);
  std::size_t offset = 0;
  for (std::uint32_t f = 0; f < faces.size(); offset += bytesOf(faces[f]), ++f) {
    const vk::BufferImageCopy copy{.bufferOffset = offset,
                                   .imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, f, 1},
                                   .imageExtent = {sizeOf(faces[f]).width, sizeOf(faces[f]).height, 1}};
    commands_.copyImageToBuffer(*canvas_->targets.colour.image, Layout::eTransferSrcOptimal, *output_->buffer, copy);
  }
  submit(drawing_, commands_);
  drawing_.context.queue.waitIdle();
  const std::byte* ids = output_->bytes;
  for (std::size_t f = 0; f < faces.size(); ids += bytesOf(faces[f]), ++f) {
    buffers[f].resize(faces[f].scissor);
    std::memcpy(buffers[f].ids.data(), ids, bytesOf(faces[f]));
    if (drawing_.areCounts()) readCounts(buffers[f]);
  }
}

void VulkanRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                          std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) try {
  for (const Face& face : faces) raster::validate(face);
  buffers.resize(faces.size());
  if (faces.empty()) return;
  const std::size_t atOnce = facesAtOnce(drawing_, sizeOf(faces));
  for (std::size_t f = 0; f < faces.size(); f += atOnce)
    drawAtOnce({faces.subspan(f, std::min(atOnce, faces.size() - f)), skipped}, &buffers[f]);
  raster::parallelFor(faces.size(), drawn);
} catch (const vk::SystemError& error) {
  throw failureOf(error);
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> makeVulkanRenderer(const raster::DrawList& list, const std::string& name,
                                                               VulkanPath path) try {
  raster::validate(list);
  return std::make_unique<VulkanRenderer>(list, path, name);
} catch (const vk::SystemError& error) {
  throw failureOf(error);
}

std::string vulkanDeviceName(const std::string& name) { return nameOf(openVulkanDevice(name).physicalDevice); }

}  // namespace hemitex::reference
