/// A wall that a device drew, for tests of verdicts.
#pragma once

#include <vector>

#include "reference/conformance/verdict/verdict.h"
#include "tests/support/raster_scenes.h"

namespace hemitex::tests {

/// Two faces of 8 x 8 and 8 x 4 pixels that look at one wall of 4 x 4 texels; its item IDs are 0x100 + texel.
struct JudgedWall {
  reference::TestVector vector;
  std::vector<raster::ItemBuffer> found;

  JudgedWall() {
    vector.name = "a <wall> & \"more\"";
    raster::DrawList& list = vector.list;
    list.format = {{8, 8, 8}};
    list.indexMaps.push_back(countingMap(4, 4));
    addDraw(list, 0x100, 0x300, 0);
    addTriangle(list, {{-1, -1, 1}, {1, 1, 1}, {1, -1, 1}}, {{0, 0}, {1, 1}, {1, 0}});
    addTriangle(list, {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}}, {{0, 0}, {0, 1}, {1, 1}});
    raster::Face face = frontFace(8);
    vector.faces.push_back({"top", face, "top.u32", ""});
    face.scissor = {0, 4, 8, 4};
    vector.faces.push_back({"side", face, "side.u32", ""});
    for (const reference::VectorFace& each : vector.faces) found.push_back(drawOne(list, each.face));
  }

  reference::Verdict verdict() const { return judge(vector, found, {}); }
};

}  // namespace hemitex::tests
