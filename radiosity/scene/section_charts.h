/// Charts for sections: the file's coordinates, the corners of a quad, or projections of planar and curved parts.
///
/// Edges are smooth where the normals of the file agree on both sides and the faces meet at no more than 60 degrees. In
/// sections without normals they are smooth where faces meet at no more than the crease angle. Parts of a chart that
/// meet at other edges are separated, unless the edges run along u or v at a multiple of 1/4.
#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/mesh_sections.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// Divides a section into surfaces with charts, which have no names and materials yet. Without texture coordinates in
/// the file, those of the chart are used. Throws InputError naming `file` if `settings` demand the file's coordinates
/// and they form no chart.
std::vector<Surface> layCharts(Section section, const PolygonMesh& mesh, const std::filesystem::path& file,
                               const SceneSettings& settings);

}  // namespace hemitex::radiosity
