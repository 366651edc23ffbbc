#include "radiosity/scene/scene_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "radiosity/base/name_suggestions.h"
#include "radiosity/base/unique_names.h"
#include "radiosity/scene/contacts.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/mtl_file.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

using raster::InputError;

/// Whether `name` is `text`, or ends with `*` and `text` begins with the rest.
bool matches(const std::string& text, const std::string& name) {
  return text == name || (name.ends_with('*') && text.starts_with(name.substr(0, name.size() - 1)));
}

bool isNamed(const Surface& surface, const std::string& name) {
  return surface.name == name || matches(surface.family, name);
}

template <typename Predicate>
std::vector<std::uint32_t> find(const std::vector<Surface>& surfaces, const Predicate& isWanted) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s)
    if (isWanted(surfaces[s])) found.push_back(s);
  return found;
}

std::vector<std::uint32_t> findNamed(const std::vector<Surface>& surfaces, const std::string& name) {
  return find(surfaces, [&](const Surface& surface) { return isNamed(surface, name); });
}

std::vector<std::uint32_t> findOrFail(const std::vector<Surface>& surfaces, const std::string& name,
                                      const std::string& where) {
  std::vector<std::uint32_t> found = findNamed(surfaces, name);
  if (!found.empty()) return found;
  std::set<std::string> families;
  for (const Surface& surface : surfaces) families.insert(surface.family);
  throw InputError("no surface " + where + " is named `" + raster::excerpt(name) + "`",
                   families.empty() ? "nothing was removed so far" : "similar names: " + nearestNames(families, name));
}

const std::string& materialOf(const Scene& scene, const Surface& surface) {
  return scene.materials[static_cast<std::size_t>(surface.material)].name;
}

/// As findNamed. A name of no surface or family may be that of a group with several materials, of parts, or of a
/// material.
std::vector<std::uint32_t> findByMaterial(const Scene& scene, const std::string& name) {
  std::vector<std::uint32_t> found = findNamed(scene.surfaces, name);
  if (found.empty())
    found = find(scene.surfaces, [&](const Surface& surface) {
      return surface.family.starts_with(name + "/" + materialOf(scene, surface)) || matches(surface.name, name);
    });
  if (found.empty())
    found = find(scene.surfaces, [&](const Surface& surface) { return matches(materialOf(scene, surface), name); });
  return found;
}

std::vector<std::uint32_t> findByMaterialOrFail(const Scene& scene, const std::string& name) {
  std::vector<std::uint32_t> found = findByMaterial(scene, name);
  if (!found.empty()) return found;
  refuseHidden(scene, name);
  std::set<std::string> names;
  for (const Surface& surface : scene.surfaces) names.insert({surface.family, materialOf(scene, surface)});
  for (const Lamp& lamp : scene.lamps) names.insert(lamp.name);
  throw InputError("no surface, group or material of the scene is named `" + raster::excerpt(name) + "`",
                   "similar names: " + nearestNames(names, name));
}

/// The numbers with those of their twins, ascending.
std::vector<std::uint32_t> withTwins(const std::vector<Surface>& surfaces, std::vector<std::uint32_t> numbers) {
  std::set<std::uint32_t> all(numbers.begin(), numbers.end());
  for (const std::uint32_t s : numbers)
    if (surfaces[s].twin) all.insert(static_cast<std::uint32_t>(*surfaces[s].twin));
  return {all.begin(), all.end()};
}

bool isWithinReach(const Scene& scene, const glm::dvec3& corner) {
  return glm::length(corner - scene.origin) <= farthestEdit * scene.extent;
}

void move(const Scene& scene, Surface& surface, const glm::dvec3& by) {
  for (Triangle& triangle : surface.triangles)
    for (glm::dvec3& corner : triangle.position) {
      corner += by;
      if (!isWithinReach(scene, corner))
        throw InputError("an edit puts `" + raster::excerpt(surface.name) + "` farther than " +
                             std::to_string(static_cast<int>(farthestEdit)) + " extents from the scene",
                         "move it less, or solve the scene anew");
    }
}

class Editor {
 public:
  Editor(Scene scene, std::vector<Surface> removed) : scene_(std::move(scene)), removed_(std::move(removed)) {
    for (std::uint32_t s = 0; s < scene_.surfaces.size(); ++s) origins_.push_back({s});
  }

  void apply(const Move& edit) {
    if (findNamed(scene_.surfaces, edit.name).empty() &&
        changeLamps(edit.name, [&](Lamp& lamp) { lamp.position += edit.by; }))
      return;
    const std::vector<std::uint32_t> moved = withTwins(scene_.surfaces, named(edit.name));
    requireWhole(moved);
    for (const std::uint32_t s : moved) {
      move(scene_, scene_.surfaces[s], edit.by);
      origins_[s].isMoved = true;
    }
    hasNewPlaces_ = true;
  }

  void apply(const Remove& edit) {
    std::vector<bool> goes(scene_.surfaces.size());
    const std::vector<std::uint32_t> removed = withTwins(scene_.surfaces, named(edit.name));
    requireWhole(removed);
    for (const std::uint32_t s : removed) goes[s] = true;
    take(scene_.surfaces, goes, removed_);
    std::vector<Origin> origins;
    for (std::size_t s = 0; s < goes.size(); ++s)
      if (!goes[s]) origins.push_back(origins_[s]);
    origins_ = std::move(origins);
    hasNewPlaces_ = true;
  }

  void apply(const Restore& edit) {
    std::vector<bool> comes(removed_.size());
    for (const std::uint32_t s : withTwins(removed_, findOrFail(removed_, edit.name, "that was removed")))
      comes[s] = true;
    take(removed_, comes, scene_.surfaces);
    origins_.resize(scene_.surfaces.size());
    hasNewPlaces_ = true;
  }

  void apply(const Add& edit) {
    Scene added = loadScene(edit.file, edit.settings);
    const auto firstMaterial = static_cast<int>(scene_.materials.size());
    const auto firstImage = static_cast<int>(scene_.images.size());
    const auto firstSurface = static_cast<int>(scene_.surfaces.size());
    const auto firstObject = static_cast<int>(scene_.objects.size());
    for (Material& material : added.materials) {
      if (material.reflectanceMap) *material.reflectanceMap += firstImage;
      if (material.emissionMap) *material.emissionMap += firstImage;
      scene_.materials.push_back(std::move(material));
    }
    UniqueNames lampNames;
    for (const Lamp& lamp : scene_.lamps) lampNames.take(lamp.name);
    for (Lamp& lamp : added.lamps) {
      lamp.name = lampNames.add(lamp.name);
      lamp.position += edit.by;
      scene_.lamps.push_back(std::move(lamp));
    }
    scene_.outside.suns.insert(scene_.outside.suns.end(), added.outside.suns.begin(), added.outside.suns.end());
    scene_.photometricLights += added.photometricLights;
    std::move(added.images.begin(), added.images.end(), std::back_inserter(scene_.images));
    std::move(added.warnings.begin(), added.warnings.end(), std::back_inserter(scene_.warnings));
    std::move(added.files.begin(), added.files.end(), std::back_inserter(scene_.files));
    for (SceneObject& object : added.objects) {
      if (object.parent) *object.parent += firstObject;
      scene_.objects.push_back(std::move(object));
    }
    const std::map<std::string, std::string> newNames = rename(added.surfaces);
    for (const auto& [covered, by] : added.coverings)
      if (newNames.contains(covered) && newNames.contains(by))
        scene_.coverings.emplace_back(newNames.at(covered), newNames.at(by));
    for (Surface& surface : added.surfaces) {
      surface.material += firstMaterial;
      if (surface.twin) *surface.twin += firstSurface;
      if (surface.object) *surface.object += firstObject;
      move(scene_, surface, edit.by);
      scene_.surfaces.push_back(std::move(surface));
    }
    origins_.resize(scene_.surfaces.size());
    hasNewPlaces_ = true;
  }

  void apply(const SetEmission& edit) {
    const glm::dvec3 radiosity = edit.radiosityPerUnit * edit.to;
    requireAll(
        radiosity, [](double value) { return value >= 0 && value <= largestEmission; },
        "the emission of `" + raster::excerpt(edit.name) + "` is below 0 or above 1e30 W/m^2");
    if (findByMaterial(scene_, edit.name).empty() &&
        changeLamps(edit.name, [&](Lamp& lamp) { lamp.intensity = edit.to; }))
      return;
    setMaterial(edit.name, [&](Material& material) {
      material.emission = radiosity;
      material.emissionSpectrum.reset();
    });
  }

  void apply(const SetReflectance& edit) {
    requireAll(
        edit.to, [](double value) { return value >= 0 && value < 1; },
        "the reflectance of `" + raster::excerpt(edit.name) + "` is not at least 0 and below 1");
    setMaterial(edit.name, [&](Material& material) {
      material.reflectance = edit.to;
      material.reflectanceSpectrum.reset();
    });
  }

  EditedScene result() && {
    if (scene_.surfaces.empty()) throw InputError("the edits leave nothing of the scene");
    if (hasNewPlaces_) findBacked(scene_);
    return {std::move(scene_), std::move(origins_), std::move(removed_)};
  }

 private:
  /// Whether lamps have the name; changes them.
  template <typename Change>
  bool changeLamps(const std::string& name, const Change& change) {
    bool isFound = false;
    for (Lamp& lamp : scene_.lamps) {
      if (!matches(lamp.name, name)) continue;
      change(lamp);
      isFound = true;
    }
    return isFound;
  }

  std::vector<std::uint32_t> named(const std::string& name) const {
    return findOrFail(scene_.surfaces, name, "of the scene");
  }

  /// Throws InputError if one of two surfaces leaves the other: what it covered has no elements.
  void requireWhole(const std::vector<std::uint32_t>& leaving) const {
    std::set<std::string> families;
    for (const std::uint32_t s : leaving) families.insert(scene_.surfaces[s].family);
    for (const auto& [covered, by] : scene_.coverings)
      if (families.contains(by) != families.contains(covered))
        throw InputError("`" + raster::excerpt(by) + "` covers a part of `" + raster::excerpt(covered) +
                             "`, which would be a hole if an edit parts them",
                         "move them a little apart in the file, or move both by one edit");
  }

  template <typename Predicate>
  static void requireAll(const glm::dvec3& value, const Predicate& holds, const std::string& message) {
    if (!holds(value.x) || !holds(value.y) || !holds(value.z)) throw InputError(message);
  }

  /// Moves surfaces to the end of another list, and updates the twin indices within each list.
  static void take(std::vector<Surface>& from, const std::vector<bool>& goes, std::vector<Surface>& to) {
    std::vector<int> number(from.size());
    int kept = 0, taken = static_cast<int>(to.size());
    for (std::size_t s = 0; s < from.size(); ++s) number[s] = goes[s] ? taken++ : kept++;
    std::vector<Surface> stay;
    for (std::size_t s = 0; s < from.size(); ++s) {
      if (from[s].twin) from[s].twin = number[static_cast<std::size_t>(*from[s].twin)];
      (goes[s] ? to : stay).push_back(std::move(from[s]));
    }
    from = std::move(stay);
  }

  /// Gives added surfaces names and families that neither the scene nor `removed` has. Returns the new families by the
  /// old ones.
  std::map<std::string, std::string> rename(std::vector<Surface>& added) const {
    UniqueNames families, names;
    for (const std::vector<Surface>* surfaces : {&scene_.surfaces, &removed_})
      for (const Surface& surface : *surfaces)
        for (const std::string& name : {surface.name, surface.family}) {
          families.take(name);
          names.take(name);
        }
    std::map<std::string, std::string> newNames;
    for (Surface& surface : added) {
      const auto [known, isNew] = newNames.try_emplace(surface.family);
      if (isNew) known->second = families.add(surface.family);
      const std::string& family = known->second;
      surface.name = names.add(family + surface.name.substr(surface.family.size()));
      surface.family = family;
    }
    return newNames;
  }

  /// Gives each surface a changed copy of its material; surfaces that shared a material share the copy.
  template <typename Change>
  void setMaterial(const std::string& name, const Change& change) {
    std::map<int, int> changed;
    for (const std::uint32_t s : findByMaterialOrFail(scene_, name)) {
      int& material = scene_.surfaces[s].material;
      const auto [copy, isNew] = changed.try_emplace(material, static_cast<int>(scene_.materials.size()));
      if (isNew) {
        Material own = scene_.materials[static_cast<std::size_t>(material)];
        change(own);
        scene_.materials.push_back(std::move(own));
      }
      material = copy->second;
    }
  }

  Scene scene_;
  std::vector<Origin> origins_;
  std::vector<Surface> removed_;
  bool hasNewPlaces_ = false;
};

/// Whether two surfaces with the same triangles have the same holes.
bool haveSameHoles(const Scene& former, const Surface& one, const Scene& next, const Surface& other) {
  const CutOut *const a = cutOutOf(former, one), *const b = cutOutOf(next, other);
  if (a == nullptr || b == nullptr) return a == b;
  const auto isSame = [](const Triangle& x, const Triangle& y) { return x.texcoord == y.texcoord; };
  return a->width == b->width && a->isHole == b->isHole && a->sampler == b->sampler &&
         std::equal(one.triangles.begin(), one.triangles.end(), other.triangles.begin(), isSame);
}

/// How far a surface moved between two readings; nothing if it has another shape, chart, name or twin.
std::optional<glm::dvec3> shiftOf(const Surface& former, const Surface& next, double tolerance) {
  if (former.name != next.name || former.family != next.family || former.twin != next.twin ||
      former.curvedPart != next.curvedPart || former.triangles.size() != next.triangles.size())
    return std::nullopt;
  const glm::dvec3 shift = next.triangles.front().position[0] - former.triangles.front().position[0];
  for (std::size_t t = 0; t < former.triangles.size(); ++t) {
    if (former.triangles[t].chart != next.triangles[t].chart) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k)
      if (glm::distance(next.triangles[t].position[k], former.triangles[t].position[k] + shift) > tolerance)
        return std::nullopt;
  }
  return shift;
}

}  // namespace

std::optional<EditedScene> readAgain(const Scene& former, Scene next) {
  if (former.surfaces.size() != next.surfaces.size()) return std::nullopt;
  const double tolerance = contactTolerance(former);
  std::vector<Origin> origins;
  for (std::uint32_t s = 0; s < next.surfaces.size(); ++s) {
    const std::optional<glm::dvec3> shift = shiftOf(former.surfaces[s], next.surfaces[s], tolerance);
    if (!shift || !haveSameHoles(former, former.surfaces[s], next, next.surfaces[s])) return std::nullopt;
    origins.push_back({s, glm::length(*shift) > tolerance});
    for (std::size_t t = 0; t < next.surfaces[s].triangles.size(); ++t) {
      std::array<glm::dvec3, 3>& corners = next.surfaces[s].triangles[t].position;
      if (!origins[s].isMoved) corners = former.surfaces[s].triangles[t].position;
      for (const glm::dvec3& corner : corners)
        if (!isWithinReach(former, corner)) return std::nullopt;
    }
  }
  next.instances = former.instances;
  next.origin = former.origin;
  next.extent = former.extent;
  next.rounding = former.rounding;
  return EditedScene{std::move(next), std::move(origins), {}};
}

EditedScene edited(Scene scene, std::vector<Surface> removed, std::span<const Edit> edits) {
  Editor editor(std::move(scene), std::move(removed));
  for (const Edit& edit : edits) std::visit([&](const auto& change) { editor.apply(change); }, edit);
  return std::move(editor).result();
}

}  // namespace hemitex::radiosity
