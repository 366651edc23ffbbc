#include "reference/devices/vulkan/tile_drawing.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "raster/base/input_error.h"
#include "reference/devices/batches.h"
#include "reference/devices/shader_inputs.h"

// SPIR-V: CMake compiles the shaders to these arrays of integers.
#include <draw_tiles.h>
#include <make_pieces.h>

namespace hemitex::reference {
namespace {

/// The twins of tiles.glsl.
struct ShaderFace {
  ShaderView view;
  std::uint32_t width, height, isMirrored, drawing;
};
struct ShaderList {
  std::uint32_t triangles;
  raster::ItemId background;
};
constexpr std::size_t bytesOfBox = 8, bytesOfPiece = 136, piecesPerTriangle = 6;

std::array<vk::DescriptorType, 9> bindingTypes() {
  std::array<vk::DescriptorType, 9> types;
  types.fill(vk::DescriptorType::eStorageBuffer);
  types.back() = vk::DescriptorType::eStorageImage;
  return types;
}

bool isDrawable(const raster::DrawList& list) {
  return raster::isUsual(list) && list.value == raster::PixelValue::ItemIds &&
         std::none_of(list.draws.begin(), list.draws.end(),
                      [](const raster::Draw& draw) { return draw.cull != raster::Cull::None; }) &&
         std::none_of(list.indexMaps.begin(), list.indexMaps.end(), raster::hasHoles);
}

std::size_t wordsOf(const TilePipeline& pipeline) { return (pipeline.triangles + 31) / 32; }

std::vector<ShaderFace> shaderFaces(const raster::DrawList& list, std::span<const DrawnView> views) {
  std::vector<ShaderFace> faces;
  for (std::uint32_t v = 0; v < views.size(); ++v)
    for (const raster::Face& face : views[v].faces)
      faces.push_back({shaderView(face, list, {}), static_cast<std::uint32_t>(face.scissor.width),
                       static_cast<std::uint32_t>(face.scissor.height), raster::determinant(face) < 0, v});
  return faces;
}

/// Sets the bits of the triangles that a view leaves out, in the order of drawing.
void setSkipped(const raster::DrawList& list, const DrawnView& view, std::span<std::uint32_t> words) {
  std::fill(words.begin(), words.end(), 0);
  std::uint32_t first = 0;
  for (const raster::Draw& draw : list.draws) {
    for (auto skip = std::lower_bound(view.skipped.begin(), view.skipped.end(), draw.first / 3);
         skip != view.skipped.end() && 3 * *skip < draw.first + draw.count; ++skip) {
      const std::uint32_t triangle = first + *skip - draw.first / 3;
      words[triangle / 32] |= 1U << triangle % 32;
    }
    first += draw.count / 3;
  }
}

}  // namespace

TilePipeline makeTilePipeline(const VulkanContext& context, const raster::DrawList& list) {
  if (!isDrawable(list))
    throw raster::InputError("compute shaders draw no holes, no culled triangles, and item IDs alone",
                             "use the device `vulkan`");
  std::uint32_t corners = 0;
  for (const raster::Draw& draw : list.draws) corners += draw.count;
  constexpr std::size_t facesOfView = 6;
  if (facesWithPieces(corners / 3, context.physicalDevice.getProperties().limits.maxStorageBufferRange) < facesOfView)
    throw raster::InputError("the clipped triangles are larger than the buffers of the Vulkan device",
                             "use the device `vulkan`");
  const VulkanDescriptors descriptors = makeDescriptors(context, bindingTypes(), vk::ShaderStageFlagBits::eCompute);
  vk::raii::PipelineLayout layout = makePipelineLayout(
      context, descriptors, {.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = sizeof(ShaderList)});
  vk::raii::Pipeline pieces = makeComputePipeline(context, layout, makePieces),
                     tiles = makeComputePipeline(context, layout, drawTiles);
  return {corners / 3, std::move(layout), std::move(pieces), std::move(tiles)};
}

std::size_t facesWithPieces(std::size_t triangles, std::size_t bytes) {
  return bytes / (std::max<std::size_t>(triangles, 1) * piecesPerTriangle * bytesOfPiece);
}

TileBuffers makeTileBuffers(const VulkanContext& context, const TilePipeline& pipeline, const DrawArrays& arrays,
                            const VulkanImage& ids, std::size_t faces, std::size_t views) {
  const std::size_t pieces = faces * piecesPerTriangle * pipeline.triangles;
  TileBuffers buffers{makeBuffer(context, faces * sizeof(ShaderFace), BufferUse::Input),
                      makeBuffer(context, views * wordsOf(pipeline) * sizeof(std::uint32_t), BufferUse::Input),
                      makeBuffer(context, faces * sizeof(std::uint32_t), BufferUse::Device),
                      makeBuffer(context, pieces * bytesOfBox, BufferUse::Device),
                      makeBuffer(context, pieces * bytesOfPiece, BufferUse::Device),
                      makeDescriptors(context, bindingTypes(), vk::ShaderStageFlagBits::eCompute)};
  std::uint32_t binding = 0;
  for (const VulkanBuffer* buffer :
       std::initializer_list<const VulkanBuffer*>{&arrays[0], &arrays[1], &arrays[2], &buffers.faces, &buffers.skipped,
                                                  &buffers.counts, &buffers.boxes, &buffers.pieces})
    bind(context, buffers.descriptors, binding++, *buffer);
  bind(context, buffers.descriptors, binding, ids, vk::DescriptorType::eStorageImage);
  return buffers;
}

void recordTiles(const vk::raii::CommandBuffer& commands, const TilePipeline& pipeline, const TileBuffers& buffers,
                 const raster::DrawList& list, std::span<const DrawnView> views) {
  constexpr auto compute = vk::PipelineBindPoint::eCompute;
  const std::vector<ShaderFace> faces = shaderFaces(list, views);
  std::memcpy(buffers.faces.bytes, faces.data(), faces.size() * sizeof(ShaderFace));
  const std::span all(reinterpret_cast<std::uint32_t*>(buffers.skipped.bytes), views.size() * wordsOf(pipeline));
  std::uint32_t columns = 0, rows = 0;
  for (const ShaderFace& face : faces) columns = std::max(columns, face.width), rows = std::max(rows, face.height);
  for (std::size_t v = 0; v < views.size(); ++v)
    setSkipped(list, views[v], all.subspan(v * wordsOf(pipeline), wordsOf(pipeline)));

  commands.fillBuffer(*buffers.counts.buffer, 0, VK_WHOLE_SIZE, 0);
  awaitWrites(commands);
  commands.bindDescriptorSets(compute, *pipeline.layout, 0, *buffers.descriptors.set, {});
  commands.pushConstants<ShaderList>(*pipeline.layout, vk::ShaderStageFlagBits::eCompute, 0,
                                     ShaderList{pipeline.triangles, raster::backgroundId(list.format)});
  commands.bindPipeline(compute, *pipeline.makePieces);
  const auto count = static_cast<std::uint32_t>(faces.size());
  commands.dispatch((pipeline.triangles + 63) / 64, count, 1);
  awaitWrites(commands);
  commands.bindPipeline(compute, *pipeline.drawTiles);
  commands.dispatch((columns + 15) / 16, (rows + 15) / 16, count);
}

}  // namespace hemitex::reference
