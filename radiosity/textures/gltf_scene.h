/// Converts a lit scene to the parts of a glTF file.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "radiosity/gltf/gltf_module.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The picture that viewers open with, and the axes and the unit of the scene.
struct PictureView {
  Camera camera;
  double aspect = 1;  ///< width over height
  int up = 1;         ///< the axis of the scene that points up: 1 for y, 2 for z
  double metresPerUnit = 1;
};

/// The surfaces of an object that share a material: a primitive of the file.
struct LitPart {
  std::optional<int> object = {};  ///< in Scene::objects
  int material = 0;
  std::vector<std::uint32_t> surfaces;  ///< ascending
};

/// The primitives of a lit scene (see makeLitScene), object by object, each by its first surface. Above `maxObjects`
/// primitives the surfaces of one material are one of no object, because each costs some kilobytes of memory here and
/// in viewers.
std::vector<LitPart> litParts(const Scene& lit, std::size_t maxObjects = 1 << 14);

/// The model of a lit scene. `textures` are its display textures; texture t is image t of the scene. Each object with
/// surfaces is a node with a mesh; those above it are nodes without, and others are left out. Positions are in world
/// space, so that only roots are moved: by the origin. A node above all turns the scene upright and scales it to
/// metres, as glTF asks, if that changes anything. Parts without object are nodes with the name of their material.
/// Throws InputError as axesOf.
GltfModel makeGltfModel(const Scene& lit, const PictureView& view, std::vector<GltfTexture> textures,
                        std::size_t maxObjects = 1 << 14);

}  // namespace hemitex::radiosity
