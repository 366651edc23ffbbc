#include "radiosity/textures/light_maps.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "radiosity/gltf/gltf_light_maps.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "radiosity/textures/second_coordinates.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Raises the scale, the largest exposed irradiance that a light map has to hold, for one that is reflected.
void raiseScale(double& scale, const glm::dvec3& exposed, const glm::dvec3& reflectance) {
  for (int band = 0; band < 3; ++band)
    if (reflectance[band] > 0) scale = std::max(scale, std::min(exposed[band], 1 / reflectance[band]));
}

/// The scale where nothing is lit is 1.
double scaleOrOne(double scale) { return scale > 0 ? scale : 1; }

/// The texture of a material with its holes, from its map or white; nothing if its map has other pixels.
std::optional<GltfTexture> cutTexture(const Scene& scene, const Material& material, const std::filesystem::path& file) {
  const CutOut& cutOut = *material.cutOut;
  Image image{cutOut.width, cutOut.height, std::vector<glm::dvec3>(cutOut.isHole.size(), glm::dvec3(1)),
              cutOut.sampler};
  if (material.reflectanceMap) image = scene.images[static_cast<std::size_t>(*material.reflectanceMap)];
  const bool isEqual = image.width == cutOut.width && image.height == cutOut.height && image.sampler == cutOut.sampler;
  if (!isEqual) return std::nullopt;
  CodedImage coded = encodeSrgb(image);
  coded.isHole = cutOut.isHole;
  return GltfTexture{material.name, encodePng(coded, file), cutOut.sampler};
}

GltfLightMap lightMapOf(const std::string& texture, const LightMaps& maps) {
  return {"lightmaps/" + texture + ".png", "lightmaps/" + texture + ".exr", maps.scale, maps.exposure};
}

/// Gives the surfaces a material per material and texture; returns them as those of a glTF file. A material of several
/// textures gets the names `MATERIAL/TEXTURE`.
std::vector<GltfMaterial> splitMaterials(Scene& scene, const TextureLayout& layout, const LightMaps& maps) {
  std::map<std::pair<int, int>, int> numbers;  // of a material and a texture
  std::map<int, int> textureCounts;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    if (numbers.try_emplace({scene.surfaces[s].material, layout.places[s].texture}, 0).second)
      ++textureCounts[scene.surfaces[s].material];
  std::vector<GltfMaterial> materials;
  for (auto& [pair, number] : numbers) {
    number = static_cast<int>(materials.size());
    const Material& material = scene.materials[static_cast<std::size_t>(pair.first)];
    const std::string& texture = layout.names[static_cast<std::size_t>(pair.second)];
    materials.push_back({textureCounts[pair.first] > 1 ? material.name + "/" + texture : material.name,
                         material.reflectanceMap, material.reflectance, material.emission, material.emissionMap,
                         lightMapOf(texture, maps), material.cutOut != nullptr});
  }
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
    scene.surfaces[s].material = numbers.at({scene.surfaces[s].material, layout.places[s].texture});
  return materials;
}

std::vector<NamedLightMap> namedLightMaps(const TextureLayout& layout, const LightMaps& maps) {
  std::vector<NamedLightMap> named;
  for (const std::string& texture : layout.names) named.push_back({texture, lightMapOf(texture, maps)});
  return named;
}

/// The triangles of a scene with their coordinates in light maps.
std::vector<GltfLitTriangle> litTriangles(const Scene& scene, const Discretization& discretization,
                                          const TextureLayout& layout) {
  std::vector<GltfLitTriangle> triangles;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      GltfLitTriangle& lit = triangles.emplace_back();
      // Backs of facets are counted behind the fronts.
      lit.polygon = triangle.polygon % static_cast<std::uint32_t>(scene.faces);
      lit.lightMap = layout.places[s].texture;
      lit.positions = triangle.position;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec2 place = textureCoordinate(discretization, layout, s, triangle.chart[k]);
        lit.lightMapCoords[k] = {place.x, 1 - place.y};
      }
    }
  return triangles;
}

/// Writes the light maps in which triangles lie.
void writeShown(const std::filesystem::path& folder, FileLightMaps lit) {
  std::vector<bool> isShown(lit.maps.size());
  for (const GltfLitTriangle& triangle : lit.triangles) isShown[static_cast<std::size_t>(triangle.lightMap)] = true;
  std::vector<std::string> names;
  std::vector<CodedImage> textures;
  std::vector<Image> linear;
  for (std::size_t i = 0; i < isShown.size(); ++i) {
    if (!isShown[i]) continue;
    names.push_back(lit.maps[i].name);
    textures.push_back(std::move(lit.textures[i]));
    linear.push_back(std::move(lit.linear[i]));
  }
  writeTextures(folder, names, textures, linear);
}

}  // namespace

LightMaps makeLightMaps(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                        const std::vector<glm::dvec3>& irradiance, double exposure, TextureFilter filter) {
  double scale = 0;
  for (std::uint32_t e = 0; e < irradiance.size(); ++e)
    raiseScale(scale, exposure * irradiance[e], reflectance(scene, discretization, e));
  scale = scaleOrOne(scale);
  return {exposure, scale,
          displayTextures(scene, discretization, layout, irradiance, exposure / scale, filter, nullptr)};
}

LightMaps makeLightMaps(const Scene& scene, const Discretization& discretization,
                        const std::vector<std::vector<glm::dvec3>>& irradiance, const std::vector<Image>& linear,
                        double exposure) {
  double scale = 0;
  for (std::size_t s = 0; s < irradiance.size(); ++s)
    for (const glm::dvec3& texel : irradiance[s])
      raiseScale(scale, exposure * texel, reflectance(scene, discretization, discretization.grids[s].firstElement));
  scale = scaleOrOne(scale);
  return {exposure, scale, codedTextures(linear, exposure / scale)};
}

std::vector<std::string> writeLightMaps(const std::filesystem::path& folder, LightMaps maps, Scene scene,
                                        const Discretization& discretization, const TextureLayout& layout,
                                        std::vector<Image> linear, const PictureView& view) {
  const std::filesystem::path images = folder / "lightmaps";
  std::filesystem::create_directory(images);
  std::vector<std::string> warnings;
  FileLightMaps lit{{}, namedLightMaps(layout, maps), std::move(maps.textures), std::move(linear)};
  if (scene.up == 1 && !scene.files.empty()) {  // glTF
    lit.triangles = litTriangles(scene, discretization, layout);
    warnings = useSecondCoordinates(scene.files.front(), lit);
    const std::string problem =
        writeWithLightMaps(folder / "lightmap.glb", scene.files.front(), lit.triangles, lit.maps);
    if (problem.empty()) {
      writeShown(images, std::move(lit));
      return warnings;
    }
    warnings = {"lightmap.glb has only what hemitex reads of the scene, because the file is not edited: " + problem};
    lit.textures.resize(layout.names.size());
    lit.linear.resize(layout.names.size());
  }
  writeTextures(images, layout.names, lit.textures, lit.linear);
  GltfModel model;
  model.origin = scene.origin;
  for (std::size_t i = 0; i < scene.images.size(); ++i)
    model.textures.push_back({"image-" + std::to_string(i + 1),
                              encodePng(encodeSrgb(scene.images[i]), folder / "lightmap.glb"),
                              scene.images[i].sampler});
  addObjects(scene);
  for (Material& material : scene.materials) {
    if (!material.cutOut) continue;
    if (auto texture = cutTexture(scene, material, folder / "lightmap.glb")) {
      material.reflectanceMap = static_cast<int>(model.textures.size());
      model.textures.push_back(std::move(*texture));
    } else {
      material.cutOut = nullptr;
      warnings.push_back("lightmap.glb shows material '" + raster::excerpt(material.name) +
                         "' without its holes, because its map_d has other pixels than its map_Kd");
    }
  }
  model.materials = splitMaterials(scene, layout, maps);
  model.objects = gltfObjects(scene, [&](std::uint32_t surface, const glm::dvec2& chart) {
    return textureCoordinate(discretization, layout, surface, chart);
  });
  model.toGltf = toGltf(view);
  model.camera = gltfCamera(scene, view);
  const std::optional<std::string> warning = writeGlb(folder / "lightmap.glb", std::move(model));
  if (warning) warnings.push_back(*warning);
  return warnings;
}

}  // namespace hemitex::radiosity
