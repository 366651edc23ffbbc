/// The file of `solve --edits`: frames, each a list of edits to the scene of the frame before.
///
///     {"frames": [
///       [{"move": "short-block", "by": [40, 0, 0]}],
///       [{"remove": "tall-block"}, {"add": "chair.obj", "by": [0, 0, 100]}],
///       [{"restore": "tall-block"}, {"emission": "light", "to": [0, 0, 0]}],
///       [{"reflectance": ["wall-red", "wall-green"], "to": [0.7, 0.7, 0.7]}]
///     ]}
///
/// A name is that of a surface or a family. A name that ends with `*` stands for all names with this beginning, and a
/// list of names for all its entries. `move` and `emission` also name lamps that are points. Paths are relative to the
/// file of edits. Emissions have the unit of `Ke` in the scene (`--emission`).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::cli {

struct Frame {
  nlohmann::ordered_json written;  ///< the JSON list of the file
  std::vector<radiosity::Edit> edits;
  std::vector<std::filesystem::path> files = {};  ///< of the scene and of all that was added so far
};

/// Reads the frames of a file and applies them to a copy of the scene, to find wrong names and numbers before the
/// solution starts. `settings` hold the unit of emissions, and are used for reading added files. Throws InputError if
/// the file cannot be read, has a wrong format or an unknown key, or if an edit is impossible.
std::vector<Frame> readEdits(const std::filesystem::path& file, const radiosity::Scene& scene,
                             const radiosity::SceneSettings& settings);

/// Throws InputError if an edit changes where objects are: a matrix has the rows of one geometry.
void requireSamePlaces(const std::vector<Frame>& frames, const std::filesystem::path& file);

}  // namespace hemitex::cli
