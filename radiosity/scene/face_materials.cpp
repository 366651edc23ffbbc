#include "radiosity/scene/face_materials.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "radiosity/scene/materials.h"
#include "radiosity/scene/mtl_file.h"

namespace hemitex::radiosity {
namespace {

/// The array of a name; null if the mesh has none.
const FaceArray* arrayNamed(const PolygonMesh& mesh, const std::string& name) {
  const auto found =
      std::find_if(mesh.arrays.begin(), mesh.arrays.end(), [&](const FaceArray& array) { return array.name == name; });
  return found == mesh.arrays.end() ? nullptr : &*found;
}

/// The value of a face in three bands.
glm::dvec3 valueOf(const FaceArray& array, std::uint32_t face) {
  if (array.components == 1) return glm::dvec3(array.values[face]);
  return {array.values[3 * face], array.values[3 * face + 1], array.values[3 * face + 2]};
}

/// The materials of faces, and how many had to be lowered.
class FaceMaterials {
 public:
  FaceMaterials(const PolygonMesh& mesh, const SceneSettings& settings, const std::filesystem::path& file)
      : mesh_(mesh),
        settings_(settings),
        file_(file),
        reflectance_(arrayNamed(mesh, settings.cellReflectance.empty() ? "reflectance" : settings.cellReflectance)),
        emission_(settings.cellEmission.empty() ? nullptr : arrayNamed(mesh, settings.cellEmission)) {}

  bool areGiven() const { return reflectance_ != nullptr || emission_ != nullptr; }

  /// The name of the material of a face.
  const std::string& nameOf(std::uint32_t face) {
    glm::dvec3 reflectance(0.5), emission(0);
    if (reflectance_) reflectance = valueOf(*reflectance_, face);
    if (emission_) emission = radiosityPerUnit(settings_.emission) * valueOf(*emission_, face);
    const std::array<double, 6> values{reflectance.x, reflectance.y, reflectance.z, emission.x, emission.y, emission.z};
    const auto [known, isNew] = names_.try_emplace(values, "m" + std::to_string(names_.size() + 1));
    if (isNew) add(known->second, reflectance, emission, face);
    return known->second;
  }

  std::map<std::string, Material> materials() { return std::move(materials_); }
  /// The warning of a material that was lowered, if there is one.
  const std::optional<std::string>& warning() const { return warning_; }

 private:
  void add(const std::string& name, glm::dvec3 reflectance, const glm::dvec3& emission, std::uint32_t face) {
    for (int band = 0; band < 3; ++band) {
      if (reflectance[band] < 0 || emission[band] < 0)
        fail({file_}, placeOf(mesh_, face) + " has a negative reflectance or emission", "give values of at least 0");
      if (emission[band] > largestEmission) fail({file_}, placeOf(mesh_, face) + " emits more than 1e30 W/m^2");
    }
    if (const auto lowered = lowerReflectance(reflectance, settings_.maxReflectance); lowered && !warning_)
      warning_ = placeOf(mesh_, face) + ", and perhaps others: " + *lowered;
    materials_[name] = {.name = name, .reflectance = reflectance, .emission = emission};
  }

  const PolygonMesh& mesh_;
  const SceneSettings& settings_;
  const std::filesystem::path& file_;
  const FaceArray *reflectance_, *emission_;
  std::map<std::array<double, 6>, std::string> names_;
  std::map<std::string, Material> materials_;
  std::optional<std::string> warning_;
};

}  // namespace

std::map<std::string, Material> divideByMaterials(PolygonMesh& mesh, const SceneSettings& settings,
                                                  const std::filesystem::path& file) {
  FaceMaterials materials(mesh, settings, file);
  if (!materials.areGiven()) return {};
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> known;
  std::vector<MeshSection> sections;
  for (std::uint32_t face = 0; face < mesh.polygons.size(); ++face) {
    MeshPolygon& polygon = mesh.polygons[face];
    const MeshSection section{mesh.sections[polygon.section].object, materials.nameOf(face)};
    const auto [place, isNew] =
        known.try_emplace({section.object, section.material}, static_cast<std::uint32_t>(sections.size()));
    if (isNew) sections.push_back(section);
    polygon.section = place->second;
  }
  mesh.sections = std::move(sections);
  if (materials.warning()) mesh.warnings.push_back(*materials.warning());
  return materials.materials();
}

}  // namespace hemitex::radiosity
