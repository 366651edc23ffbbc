/// Rasterizers that are written in Python, and the draw lists and faces that they get.
#pragma once

#include <optional>
#include <vector>

#include "python/bindings/calls.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::python {

/// A draw list as a dictionary: `positions` (n, 3) and `texcoords` (n, 2) in binary32, `triangles` (m, 3), `draws` as a
/// list of dictionaries, `index_maps` as a list of arrays (height, width), `channel_bits`, `blend`.
py::dict toDict(const raster::DrawList& list);
/// The reverse; throws InputError for what raster::validate refuses, and for numbers that are not finite.
raster::DrawList drawListOf(const py::dict& dictionary);

/// A face: `eye`, `x`, `y`, `w`, `near`, `resolution`, `scissor` (column, row, width, height).
py::dict toDict(const raster::Face& face);
raster::Face faceOf(const py::dict& dictionary);

/// An item buffer as an array (height, width), without a copy.
py::object toArray(raster::ItemBuffer buffer);
/// The reverse. Throws InputError for another shape than that of the face, and for item IDs wider than the format.
raster::ItemBuffer itemBufferOf(const py::handle& array, const raster::Face& face, const raster::IdFormat& format,
                                const std::string& name);

/// The renderers of `make`, which takes a draw list and returns a function of a face and of the numbers of skipped
/// triangles, which returns the item IDs (height, width); or those of a device with this name, which is judged first
/// (reference/devices/choice). None: the reference renderer.
radiosity::RendererFactory rendererFactory(py::object make);

}  // namespace hemitex::python
