/// Writes the lit scene: OBJ and MTL with radiosity textures, which any OBJ viewer shows, and glTF.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "radiosity/textures/gltf_scene.h"
#include "radiosity/textures/map_texels.h"
#include "radiosity/textures/texture_filter.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

/// A scene as loadScene reads it from the files of writeLitScene, but with its images as codes.
struct LitScene {
  Scene scene;  ///< without images
  TextureLayout layout;
  std::vector<CodedImage> textures;  ///< the display textures; texture t is image t of the scene
};

/// The textures of values per element, in W/m^2: filtered and magnified as `layout` says, with `maps` (see
/// levelsOfMaps) if there are any, times `exposure`, with the 256 values per channel that an 8-bit sRGB file holds. A
/// surface of one texel without maps whose corners differ is Gouraud shaded instead (see drawCorners). Throws
/// InputError as filteredTexture.
std::vector<CodedImage> displayTextures(const Scene& scene, const Discretization& discretization,
                                        const TextureLayout& layout, const std::vector<glm::dvec3>& values,
                                        double exposure, TextureFilter filter, const std::vector<ImageLevels>* maps);

/// Linear textures, in W/m^2, times `exposure` as 8-bit codes.
std::vector<CodedImage> codedTextures(const std::vector<Image>& linear, double exposure);

/// Writes NAME.png, the codes, and NAME.exr, the linear values, per texture into a folder. Returns the PNG files.
/// Throws InputError where a file cannot be written.
std::vector<GltfTexture> writeTextures(const std::filesystem::path& folder, const std::vector<std::string>& names,
                                       const std::vector<CodedImage>& codes, const std::vector<Image>& linear);

/// Gives each surface without an object its own.
void addObjects(Scene& scene);

/// The surfaces of a scene, lit. The reflectance map of a surface is its display texture: `displayed` (see
/// displayValues) as displayTextures gives it. Objects are those of the scene. There is a material per name of a
/// material and texture, named `NAME`, or `NAME/TEXTURE` if that has several. Throws InputError as filteredTexture.
LitScene makeLitScene(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      const std::vector<glm::dvec3>& displayed, double exposure, TextureFilter filter);
/// The same with these display textures, one per texture of the layout.
LitScene makeLitScene(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      std::vector<CodedImage> textures);

/// The picture that unlitPicture makes of the scene that is read again.
Image unlitPicture(const LitScene& lit, const Camera& camera, int width, int height,
                   const glm::dvec3& background = glm::dvec3(0.0));

/// Writes into `folder`, which exists: scene.obj, scene.mtl, scene.glb and per texture NAME.png, the display texture,
/// with alpha where surfaces have holes, and NAME.exr, the `linear` one in W/m^2 (see radiosityTextures). Triangles are
/// grouped by object and surface, in the order and winding of the scene. Each object of the scene is one of scene.obj,
/// where names have no blanks. For scene.glb see makeGltfModel; a scene that is too large for that format is written
/// without it. Returns warnings for the user. Throws InputError where a file cannot be written.
std::vector<std::string> writeLitScene(const std::filesystem::path& folder, const LitScene& lit,
                                       const PictureView& view, const std::vector<Image>& linear);

}  // namespace hemitex::radiosity
