/// Charts for sections: the file's coordinates, the corners of a quad, or planar parts.
#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/scene/mesh_sections.h"
#include "radiosity/scene/polygon_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// Returns the triangles of a section with charts, one vector per surface. Without texture coordinates in the file,
/// those of the chart are used. Throws InputError naming `file` if `charts` demands the file's coordinates and they
/// form no chart.
std::vector<std::vector<Triangle>> layCharts(Section section, const PolygonMesh& mesh,
                                             const std::filesystem::path& file, Charts charts);

}  // namespace hemitex::radiosity
