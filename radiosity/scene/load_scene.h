/// Reads a scene file with its materials and images. The end of its name says the format: glTF (.gltf, .glb), STL, PLY,
/// VTK (.vtu, .vtp, .vtk), View3D (.vs3), and OBJ for all others.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/materials.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::radiosity {

/// Reads a file, and the MTL files and images that it names. See gltf_file.h for the parts of glTF that are read.
///
/// Throws InputError, with the file and the line of a text, for a malformed or non-finite number, an index out of
/// range, or a negative reflectance or emission. Also throws it for a scene without faces, or one too small or too
/// large for binary32. Repairs other faults and reports them in `warnings`: degenerate faces, missing materials or
/// textures, reflectances of 1, missing normals.
///
/// A face is degenerate if none of its triangles has area (see hasArea). Triangles without area of other faces are
/// dropped without a warning. A scene without emission is no error here; callers that need light call requireEmission.
Scene loadScene(const std::filesystem::path& file, const SceneSettings& settings = {});

/// Gives the materials of names, one each (see findMaterials); the empty name stands for faces without a material.
using MaterialSource = std::function<MaterialSet(const std::vector<std::string>& names)>;

/// The scene of a mesh, as loadScene makes it: sections become surfaces with charts. Messages name `file`. Throws
/// InputError as loadScene, and what `materials` throws.
Scene makeScene(PolygonMesh mesh, const MaterialSource& materials, const std::filesystem::path& file,
                const SceneSettings& settings = {});

/// The faces of a file as they are there, which facets are numbered by, without materials; with Sides::Two also their
/// backs. Throws InputError as loadScene.
PolygonMesh readFaces(const std::filesystem::path& file, Sides sides = Sides::One);

/// Faces, and behind them their backs in the same order.
PolygonMesh withBacks(PolygonMesh faces);

/// Whether a file has a format of plain meshes, without materials, in which each face counts: all but OBJ and glTF.
bool isPlainMesh(const std::filesystem::path& file);

/// Whether a surface emits in any band, or light comes from outside.
bool emitsLight(const Scene& scene);

/// Throws InputError if there is no light (see emitsLight), or if it is too weak for the range of images.
void requireEmission(const Scene& scene, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
