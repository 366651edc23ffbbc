/// Converts a lit scene to the parts of a glTF file.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
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

/// The second texture coordinate of a place in the chart of a surface; v = 0 is the BOTTOM of the texture.
using CoordinateOf = std::function<glm::dvec2(std::uint32_t surface, const glm::dvec2& chart)>;

/// The nodes of the parts of a scene, with `second` coordinates if there are any. Each object with surfaces is a node
/// with a mesh; those above it are nodes without, and others are left out. Positions are in world space, so that only
/// roots are moved: by the origin. Parts without object are nodes with the name of their material.
std::vector<GltfObject> gltfObjects(const Scene& scene, const CoordinateOf& second = {},
                                    std::size_t maxObjects = 1 << 14);

/// The camera of a view. Its planes enclose the scene and leave a viewer with 24 bits of depth enough of them: a camera
/// at a wall of a room of 5 m sees what is farther than 5 mm. Throws InputError as axesOf.
GltfCamera gltfCamera(const Scene& scene, const PictureView& view);

/// From the coordinates of the scene to those of glTF: upright, in metres.
glm::dmat4 toGltf(const PictureView& view);

/// The model of a lit scene. `textures` are its display textures; texture t is image t of the scene.
/// Throws InputError as axesOf.
GltfModel makeGltfModel(const Scene& lit, const PictureView& view, std::vector<GltfTexture> textures,
                        std::size_t maxObjects = 1 << 14);

}  // namespace hemitex::radiosity
