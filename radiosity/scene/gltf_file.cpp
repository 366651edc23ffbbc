#include "radiosity/scene/gltf_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "radiosity/base/unique_names.h"
#include "radiosity/gltf/gltf_module.h"
#include "radiosity/images/image.h"
#include "radiosity/scene/mtl_file.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {
namespace {

using raster::InputError;

/// The reflectance where a file states no colour: white paint, because the 1 that glTF means would keep all light in a
/// closed room.
constexpr double unstatedReflectance = 0.8;

GltfImport import(const std::filesystem::path& file) {
  const std::string bytes = raster::readFile(file, "check the path, and that it is a file you may read");
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  raster::RunningRequest ofFiles(file.string(), "the set of files that it names");
  const ImportBudget budget{
      [&](std::uint64_t size, const std::string&) { ofFiles.add(size); },
      [&](std::uint64_t triangles, std::uint64_t vertices) {
        constexpr std::uint64_t bytesPerVertex = 2 * sizeof(glm::dvec3);
        raster::requireMemory(raster::saturatedSum(raster::saturatedProduct(triangles, bytesPerTriangle),
                                                   raster::saturatedProduct(vertices, bytesPerVertex)),
                              file.string(),
                              "the scene of " + std::to_string(triangles) + " triangles, with those that nodes repeat,",
                              "divide it");
      }};
  GltfImport imported;
  try {
    const ImportProblem problem = gltfReader().read(bytes, folder, budget, imported);
    if (!problem.problem.empty()) throw InputError(file.string(), 0, problem.problem, problem.advice);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(file.string(), 0,
                     std::string("needs the module for glTF, which cannot be opened: ") + error.what(),
                     "install hemitex again, or build it with CMake");
  }
  return imported;
}

/// Appends parts to a mesh.
class MeshBuilder {
 public:
  explicit MeshBuilder(const std::filesystem::path& file) : file_(file) {}

  void add(const ImportedPart& part, const std::string& material) {
    const std::size_t firstPosition = mesh_.positions.size(), firstTexcoord = mesh_.texcoords.size(),
                      firstNormal = mesh_.normals.size();
    constexpr std::size_t maxCount = std::numeric_limits<std::uint32_t>::max();
    if (mesh_.corners.size() + part.corners.size() > maxCount || firstPosition + part.positions.size() > maxCount)
      throw InputError(file_.string(), 0, "the scene has more than 2^32 corners", "divide it");
    for (std::size_t v = 0; v < part.positions.size(); ++v) {
      addPosition(part.positions[v]);
      if (!part.colours.empty()) setColour(mesh_, part.colours[v]);
    }
    for (const glm::dvec2& texcoord : part.texcoords) addTexcoord(texcoord);
    mesh_.normals.insert(mesh_.normals.end(), part.normals.begin(), part.normals.end());
    const std::uint32_t section = sectionOf(static_cast<std::uint32_t>(part.node), material);
    for (std::size_t c = 0; c < part.corners.size(); c += 3) {
      mesh_.polygons.push_back({.firstCorner = static_cast<std::uint32_t>(mesh_.corners.size()),
                                .cornerCount = 3,
                                .section = section,
                                .textured = !part.texcoords.empty()});
      for (std::size_t k = c; k < c + 3; ++k) {
        MeshCorner corner{static_cast<std::uint32_t>(firstPosition + part.corners[k])};
        if (!part.texcoords.empty()) corner.texcoord = static_cast<std::uint32_t>(firstTexcoord + part.corners[k]);
        if (!part.normals.empty()) corner.normal = static_cast<std::uint32_t>(firstNormal + part.corners[k]);
        mesh_.corners.push_back(corner);
      }
    }
  }

  PolygonMesh mesh() && { return std::move(mesh_); }

 private:
  void addPosition(const glm::dvec3& position) { radiosity::addPosition(mesh_, position, {file_}); }

  /// glTF measures v from the top of an image, a scene from its bottom.
  void addTexcoord(const glm::dvec2& texcoord) {
    if (std::max(std::fabs(texcoord.x), std::fabs(texcoord.y)) > largestCoordinate)
      throw InputError(file_.string(), 0, "a texture coordinate is above 1e18 in size",
                       "use coordinates from 0 to 1, or of some repetitions");
    mesh_.texcoords.emplace_back(texcoord.x, 1 - texcoord.y);
  }

  std::uint32_t sectionOf(std::uint32_t object, const std::string& material) {
    const auto known = sections_.try_emplace({object, material}, static_cast<std::uint32_t>(mesh_.sections.size()));
    if (known.second) mesh_.sections.push_back({object, material});
    return known.first->second;
  }

  const std::filesystem::path& file_;
  PolygonMesh mesh_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> sections_;
};

/// Decodes the images of materials; each is decoded once.
class DecodedImages {
 public:
  DecodedImages(const GltfFile& gltf, const std::filesystem::path& file, MaterialSet& set)
      : gltf_(gltf), file_(file), set_(set), memory_(file.string(), imagesOfScene) {}

  /// The index of an image with a sampler in the set; nothing, with a warning, if it is missing or broken.
  std::optional<int> decode(int image, const Sampler& sampler) {
    const auto [known, isNew] = decoded_.try_emplace(image);
    if (isNew) known->second = decodeNew(gltf_.images[static_cast<std::size_t>(image)]);
    if (!known->second) return {};
    return withSampler(set_, *known->second, sampler, variants_[image], memory_);
  }

  const Image& at(int image) const { return set_.images[static_cast<std::size_t>(image)]; }

 private:
  std::optional<int> decodeNew(const ImportedImage& image) {
    if (image.bytes.empty()) {
      set_.warnings.push_back(file_.string() + ": the image " + image.name + " cannot be read; 0.5 stands for it");
      return {};
    }
    try {
      Image decoded = decodeImage(image.bytes, file_.string() + ": " + image.name);
      memory_.add(decoded.pixels.size() * sizeof decoded.pixels[0]);
      set_.images.push_back(std::move(decoded));
    } catch (const raster::SizeError&) {
      throw;
    } catch (const InputError& error) {
      set_.warnings.push_back(std::string(error.what()) + "; 0.5 stands for it");
      return {};
    }
    return static_cast<int>(set_.images.size()) - 1;
  }

  const GltfFile& gltf_;
  const std::filesystem::path& file_;
  MaterialSet& set_;
  raster::RunningRequest memory_;
  std::map<int, std::optional<int>> decoded_;
  std::map<int, std::vector<int>> variants_;  ///< see withSampler
};

/// The holes of alphaMode MASK: where alpha is below the cutoff.
void cut(const ImportedMaterial& given, DecodedImages& images, Material& material) {
  const Image opaque{1, 1, {glm::dvec3(1)}};
  const CutOut cutOut =
      cutOutOf(material.reflectanceMap ? images.at(*material.reflectanceMap) : opaque, given.alpha, *given.cutoff);
  if (std::find(cutOut.isHole.begin(), cutOut.isHole.end(), true) == cutOut.isHole.end()) return;
  material.cutOut = std::make_shared<CutOut>(cutOut);
  material.isDoubleSided = given.isDoubleSided;
}

/// `isColoured`: its faces have colours of vertices.
Material materialOf(const ImportedMaterial& given, bool isColoured, DecodedImages& images,
                    const std::filesystem::path& file, const SceneSettings& settings,
                    std::vector<std::string>& warnings) {
  const bool isStated = given.baseColor || given.baseColorImage || isColoured;
  Material material{.name = given.name,
                    .reflectance = given.baseColor.value_or(glm::dvec3(isStated ? 1 : unstatedReflectance))};
  const std::string owner = "material '" + given.name + "': ";
  const auto warning = lowerReflectance(material.reflectance, settings.maxReflectance);
  // Most textures have the factor 1, which only says that they are the colour; so do colours of vertices.
  if (!isStated) warnings.push_back(owner + "it states no colour; the reflectance 0.8 stands for it");
  if (warning && !given.baseColorImage && !isColoured) warnings.push_back(owner + *warning);
  if (given.baseColorImage) {
    material.reflectanceMap = images.decode(*given.baseColorImage, given.baseColorSampler);
    if (!material.reflectanceMap) material.reflectance = glm::dvec3(grey);
  }
  if (given.cutoff) cut(given, images, material);
  if (!given.transparency.empty()) warnings.push_back(owner + opaqueWarning(given.transparency));
  material.emission = given.emission * radiosityPerUnit(settings.emission);
  if (std::max({material.emission.r, material.emission.g, material.emission.b}) > largestEmission)
    throw InputError(file.string(), 0, owner + "its emission is above 1e30 W/m^2", "scale the light down");
  if (given.emissionImage && bandSum(given.emission) == 0)
    warnings.push_back(owner + "its emissiveTexture has the emissiveFactor 0, and emits nothing");
  if (given.emissionImage && bandSum(given.emission) > 0) {
    material.emissionMap = images.decode(*given.emissionImage, given.emissionSampler);
    if (!material.emissionMap) material.emission *= grey;
  }
  return material;
}

/// The materials of faces with colours of vertices.
std::set<std::string> colouredMaterials(const PolygonMesh& mesh) {
  std::set<std::string> names;
  for (std::size_t p = 0; p < mesh.polygons.size() && !mesh.colours.empty(); ++p) {
    const MeshPolygon& polygon = mesh.polygons[p];
    const auto corners = std::span(mesh.corners).subspan(polygon.firstCorner, polygon.cornerCount);
    if (std::any_of(corners.begin(), corners.end(),
                    [&](const MeshCorner& corner) { return mesh.colours[corner.position] != glm::vec3(1); }))
      names.insert(mesh.sections[polygon.section].material);
  }
  return names;
}

/// A ramp of the intensity of less than a thousandth in the cosine becomes one of that, as the specification says.
LampCone coneOf(const ImportedLight& light) {
  constexpr double narrowestRamp = 0.001;
  const double outer = std::max(std::cos(light.outerAngle), 0.0);
  return {light.direction, outer + std::max(std::cos(light.innerAngle) - outer, std::min(narrowestRamp, 1 - outer)),
          outer};
}

}  // namespace

GltfFile readGltf(const std::filesystem::path& file) {
  GltfImport imported = import(file);
  MeshBuilder builder(file);
  for (const ImportedPart& part : imported.parts)
    builder.add(part,
                part.material ? imported.materials[static_cast<std::size_t>(*part.material)].name : std::string());
  GltfFile gltf{std::move(builder).mesh(),
                std::move(imported.materials),
                std::move(imported.images),
                std::move(imported.lights),
                {},
                {}};
  for (ImportedNode& node : imported.nodes) gltf.mesh.objects.push_back({std::move(node.name), node.parent});
  gltf.mesh.warnings = std::move(imported.warnings);
  gltf.files.assign(imported.files.begin(), imported.files.end());
  if (const auto& camera = imported.camera)
    gltf.camera = SceneCamera{camera->eye, camera->eye + camera->direction, camera->up, camera->fov};
  return gltf;
}

MaterialSet gltfMaterials(const std::vector<std::string>& names, const GltfFile& gltf,
                          const std::filesystem::path& file, const SceneSettings& settings) {
  MaterialSet set;
  set.files = gltf.files;
  DecodedImages images(gltf, file, set);
  std::map<std::string_view, const ImportedMaterial*> materials;
  for (const ImportedMaterial& material : gltf.materials) materials.emplace(material.name, &material);
  const std::set<std::string> coloured = colouredMaterials(gltf.mesh);
  for (const std::string& name : names) {
    if (const auto given = materials.find(name); given != materials.end()) {
      set.materials.push_back(
          materialOf(*given->second, coloured.contains(name), images, file, settings, set.warnings));
    } else if (coloured.contains(name)) {
      set.materials.push_back({.name = "default", .reflectance = glm::dvec3(settings.maxReflectance)});
    } else {
      set.materials.push_back({.name = "default", .reflectance = glm::dvec3(unstatedReflectance)});
      set.warnings.push_back("faces without a material get the reflectance 0.8");
    }
  }
  return set;
}

void addLights(Scene& scene, const std::vector<ImportedLight>& lights, const std::filesystem::path& file,
               const SceneSettings& settings) {
  UniqueNames names;
  for (const ImportedLight& light : lights) {
    const glm::dvec3 value = light.intensity / settings.lumensPerWatt;
    if (largestBand(value) > largestEmission)
      throw InputError(file.string(), 0, "the light `" + raster::excerpt(light.name) + "` is above 1e30 W/sr or W/m^2",
                       "scale it down");
    if (light.kind == ImportedLight::Kind::Directional)
      scene.outside.suns.push_back({-light.direction, value});
    else
      scene.lamps.push_back({names.add(light.name), light.position, value,
                             light.kind == ImportedLight::Kind::Spot ? std::optional(coneOf(light)) : std::nullopt});
    ++scene.photometricLights;
  }
}

}  // namespace hemitex::radiosity
