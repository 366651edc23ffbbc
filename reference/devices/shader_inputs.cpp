#include "reference/devices/shader_inputs.h"

#include "raster/plain/rules.h"

namespace hemitex::reference {

std::uint32_t channelEnds(const raster::IdFormat& format) {
  std::uint32_t ends = 0;
  int shift = 0;
  for (const int bits : format.channelBits) {
    shift += bits;
    ends |= 1u << (shift - 1);
  }
  return ends;
}

std::vector<ShaderCorner> shaderCorners(const raster::DrawList& list) {
  std::vector<ShaderCorner> corners;
  for (std::uint32_t d = 0; d < list.draws.size(); ++d) {
    const raster::Draw& draw = list.draws[d];
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i) {
      const std::uint32_t vertex = list.indices[i];
      corners.push_back({list.positions[vertex], list.clipZ.empty() ? -1 : list.clipZ[vertex], list.texcoords[vertex],
                         d, raster::flatValue(list, draw, i / 3)});
    }
  }
  return corners;
}

std::vector<ShaderDraw> shaderDraws(const raster::DrawList& list) {
  std::vector<std::uint32_t> firstTexels;
  std::size_t texels = 0;
  for (const raster::IndexMap& map : list.indexMaps) {
    firstTexels.push_back(static_cast<std::uint32_t>(texels));
    texels += map.ids.size();
  }
  std::vector<ShaderDraw> draws;
  for (const raster::Draw& draw : list.draws) {
    ShaderDraw shaderDraw{draw.offset, draw.back.value_or(0),      draw.back.has_value(), 0, 0,
                          0,           static_cast<int>(draw.cull)};
    if (draw.indexMap) {
      const auto m = static_cast<std::size_t>(*draw.indexMap);
      shaderDraw.firstTexel = firstTexels[m];
      shaderDraw.width = list.indexMaps[m].width;
      shaderDraw.height = list.indexMaps[m].height;
    }
    draws.push_back(shaderDraw);
  }
  return draws;
}

std::vector<raster::ItemId> shaderTexels(const raster::DrawList& list) {
  std::vector<raster::ItemId> texels;
  for (const raster::IndexMap& map : list.indexMaps) texels.insert(texels.end(), map.ids.begin(), map.ids.end());
  return texels;
}

ShaderView shaderView(const raster::Face& face, const raster::DrawList& list, const DeviceViewport& viewport) {
  const raster::Viewport size = raster::viewportOf(face);
  const raster::DepthRule depth = raster::depthRuleOf(list, face);
  const bool isExactScene =
      list.clipDepth == raster::ClipDepth::None && list.depthPrecision == raster::DepthPrecision::Exact;
  return {.eye = face.eye,
          .near = face.nearDistance,
          .x = face.x,
          .sampleOffset = face.sample == raster::SamplePlace::Corner ? 128.0F : 0.0F,
          .y = face.y,
          .channelEnds = channelEnds(list.format),
          .w = face.w,
          .blend = list.blend,
          .scissor = {face.scissor.column, face.scissor.row},
          .size = {size.columns, size.rows},
          .viewport = {viewport.columns, viewport.rows},
          .value = static_cast<int>(list.value),
          .clipDepth = static_cast<int>(list.clipDepth),
          .depthScale = isExactScene ? 0 : static_cast<float>(depth.scale),
          .depthOffset = static_cast<float>(depth.offset)};
}

}  // namespace hemitex::reference
