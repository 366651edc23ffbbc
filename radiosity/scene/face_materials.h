/// Materials of faces whose file has their reflectance and emission as values: cell data of VTK, emittances of View3D.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// Gives each different pair of reflectance and emission a material, named `m1`, `m2`, ... in the order of faces, and
/// divides the sections of the mesh by materials. One component stands for all three bands. The reflectance is the
/// array that the settings name, else the array `reflectance`, else 0.5; the emission is 0 where none is named. A
/// reflectance of 1 or more is lowered, with a warning of the mesh. Throws InputError, with the face, for negative
/// values and emissions above 1e30.
///
/// Returns the materials by name; none, without a change, for a mesh without such arrays.
std::map<std::string, Material> divideByMaterials(PolygonMesh& mesh, const SceneSettings& settings,
                                                  const std::filesystem::path& file);

}  // namespace hemitex::radiosity
