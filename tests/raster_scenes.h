/// Small draw lists and faces for the tests of the rasterizer, and drawing them.
#pragma once

#include "raster/software_renderer.h"
#include "reference/simple_draws.h"

namespace hemitex::tests {

using reference::addDraw;
using reference::addPixel;
using reference::addTriangle;
using reference::countingMap;
using reference::frontFace;
using reference::plainList;
using reference::uniform;

inline raster::ItemBuffer drawOne(const raster::DrawList& list, const raster::Face& face,
                                  std::span<const std::uint32_t> skipped = {}) {
  return raster::SoftwareRenderer(list).render({&face, 1}, skipped).front();
}

}  // namespace hemitex::tests
