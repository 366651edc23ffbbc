/// From an OBJ file with its materials and images to a scene.
#pragma once

#include <filesystem>

#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// Reads an OBJ file and the MTL files and images it names. Throws InputError, with file and line, on a malformed or
/// non-finite number, an index out of range, a negative reflectance or emission, a scene without faces, or one too
/// small or too large for binary32. What can be mended (degenerate faces, missing materials or textures, reflectances
/// of 1) is mended and told in `warnings`. A face is degenerate where none of its triangles has area (see hasArea); a
/// triangle without area of another face is left out in silence. A scene without emission is no error here: whether
/// light is needed is for the caller to say (see requireEmission).
Scene loadScene(const std::filesystem::path& file, const SceneSettings& settings = {});

/// Throws InputError where nothing in the scene emits, or no more than images can hold.
void requireEmission(const Scene& scene, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
