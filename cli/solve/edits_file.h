/// The file of `solve --edits`: frames, each a list of edits to the scene of the frame before.
///
///     {"frames": [
///       [{"move": "short-block", "by": [40, 0, 0]}],
///       [{"remove": "tall-block"}, {"add": "chair.obj", "by": [0, 0, 100]}],
///       [{"restore": "tall-block"}, {"emission": "light", "to": [0, 0, 0]}],
///       [{"reflectance": ["wall-red", "wall-green"], "to": [0.7, 0.7, 0.7]}]
///     ]}
///
/// A name is that of a surface or a family, or ends with `*` and means all whose names begin so; a list of names means
/// all of them. Files are found beside the file of edits. Emissions have the unit of `Ke` in the scene (`--emission`).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::cli {

struct Frame {
  nlohmann::ordered_json written;  ///< the list as it stands in the file
  std::vector<radiosity::Edit> edits;
};

/// Throws InputError where the file cannot be read, is no such list of frames, has a key that no edit has, or an edit
/// cannot be made, frame after frame, to the scene: names that it does not have, numbers out of range. `settings`
/// say how files that are added are read, and in which unit emissions are.
std::vector<Frame> readEdits(const std::filesystem::path& file, const radiosity::Scene& scene,
                             const radiosity::SceneSettings& settings);

}  // namespace hemitex::cli
