/// Options that change the light and the reflectances of a scene: `--emit`, `--reflectance`, `--sky`, `--sun`, `--lamp`
/// and `--lights`. A name is that of a surface, a group or a material; `*` at its end means any rest (scene_edits.h).
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/options.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::cli {

/// The new emission or reflectance of the surfaces with a name.
struct NamedColor {
  std::string name;
  glm::dvec3 color;    ///< per RGB band, finite and not negative
  std::string source;  ///< the option or the file, for messages
};

struct MaterialOptions {
  std::vector<NamedColor> emissions;     ///< of `--lights`, then of `--emit`; in the unit of `Ke`
  std::vector<NamedColor> reflectances;  ///< of `--reflectance`
  std::optional<glm::dvec3> sky;         ///< of `--sky`, else of `--lights`
  std::vector<radiosity::Sun> suns;      ///< of `--sun`, else of `--lights`
  std::vector<radiosity::Lamp> lamps;    ///< of `--lamp`, without names

  bool changeMaterials() const { return !emissions.empty() || !reflectances.empty(); }
  bool areGiven() const { return changeMaterials() || sky || !suns.empty() || !lamps.empty(); }
};

void addMaterialOptions(Command command, MaterialOptions& options);

/// The scene with the changes, and with the lights that are added to those of the file. Later changes override earlier
/// ones. A reflectance of 1 or more is lowered to `settings.maxReflectance` with a warning, as Kd is. Lamps are
/// `lamp-1`, `lamp-2`, ... behind those of the file. Throws InputError with similar names for a name of no surface,
/// group, material or lamp, and for light above 1e30 W/m^2 or W/sr.
radiosity::Scene withMaterials(radiosity::Scene scene, const MaterialOptions& options,
                               const radiosity::SceneSettings& settings);

/// The given changes in the form of edits: `[{"emission": NAME, "to": [r, g, b]}, ...]`.
nlohmann::ordered_json toJson(const MaterialOptions& options);

/// The light that no surface emits, without what a scene lacks: `{"sky": [r, g, b], "sun": [{"towards": [x, y, z],
/// "irradiance": [r, g, b]}, ...], "lamp": [{"name": NAME, "position": [x, y, z], "intensity": [r, g, b]}, ...]}`. A
/// spot also has `axis`, `inner_cosine` and `outer_cosine`.
nlohmann::ordered_json lightsJson(const radiosity::Scene& scene);
/// Gives a scene the lights of such settings instead of its own. Throws std::exception if they are malformed.
void restoreLights(radiosity::Scene& scene, const nlohmann::ordered_json& settings);

}  // namespace hemitex::cli
