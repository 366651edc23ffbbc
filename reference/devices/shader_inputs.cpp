#include "reference/devices/shader_inputs.h"

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
  for (std::uint32_t d = 0; d < list.draws.size(); ++d)
    for (std::uint32_t i = list.draws[d].first; i < list.draws[d].first + list.draws[d].count; ++i)
      corners.push_back({list.positions[list.indices[i]], list.texcoords[list.indices[i]], d});
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
  int triangles = 0;
  for (const raster::Draw& draw : list.draws) {
    ShaderDraw shaderDraw{
        draw.offset, draw.back.value_or(0), draw.back.has_value(), 0, 0, 0, static_cast<int>(draw.cull), triangles};
    triangles += static_cast<int>(draw.count / 3);
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

ShaderView shaderView(const raster::Face& face, const raster::DrawList& list, int width) {
  return {.eye = face.eye,
          .near = face.nearDistance,
          .x = face.x,
          .resolution = static_cast<float>(face.resolution),
          .y = face.y,
          .width = static_cast<float>(width),
          .w = face.w,
          .channelEnds = channelEnds(list.format),
          .scissor = {face.scissor.column, face.scissor.row},
          .blend = list.blend,
          .value = static_cast<int>(list.value)};
}

}  // namespace hemitex::reference
