/// Charts for sections: the file's coordinates, a quad's corners, or planar parts.
#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/scene/mesh_sections.h"
#include "radiosity/scene/obj_file.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// The triangles of a section with their charts, a vector for each surface that it becomes. Where the file has no
/// texture coordinates the chart's take their place. Throws InputError, naming `file`, where `charts` asks for
/// coordinates that form no chart.
std::vector<std::vector<Triangle>> layCharts(Section section, const ObjFile& obj, const std::filesystem::path& file,
                                             Charts charts);

}  // namespace hemitex::radiosity
