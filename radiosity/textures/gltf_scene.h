/// Converts a lit scene to the parts of a glTF file.
#pragma once

#include <vector>

#include "radiosity/gltf/gltf_module.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The picture that viewers open with.
struct PictureView {
  Camera camera;
  double aspect = 1;  ///< width over height
};

/// The model of a lit scene (see makeLitScene). `pngs` are the files of its display textures; texture t is the
/// reflectance map of material t. Each surface is an object. Above `maxObjects` surfaces those of one material are one
/// object, because each object costs some kilobytes of memory here and in viewers. Throws InputError as axesOf.
GltfModel makeGltfModel(const Scene& lit, const PictureView& view, std::vector<std::vector<unsigned char>> pngs,
                        std::size_t maxObjects = 1 << 14);

}  // namespace hemitex::radiosity
