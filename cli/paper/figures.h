/// The pictures of `hemitex paper`: all panels of Figures 2, 3 and 4 of Nielsen and Christensen (2002), made again, and
/// what the paper says but does not show.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/paper/scenes.h"

namespace hemitex::cli {

/// Called before each part with what it is.
using PictureProgress = std::function<void(const std::string& what)>;

/// Writes the pictures into `folder` as PNG files and returns a list of
/// `{figure, panel, file, caption}`; `figure` is 2, 3 or 4, or 0 for what the paper does not show. The scenes `simple`
/// and `complex` are solved at their medium levels; others come from the scene folder.
nlohmann::ordered_json writePaperFigures(const std::filesystem::path& sceneFolder,
                                         const std::vector<reference::PaperScene>& scenes,
                                         const std::filesystem::path& folder, const PictureProgress& progress);

/// The phantom indices of the scenes' medium levels, by the way in which index maps are used: a list of
/// `{scene, index_maps, offsets, item IDs, spare_texels, alignment_gaps}` (see radiosity/index_maps/phantom_indices.h).
nlohmann::ordered_json phantomsJson(const std::vector<reference::PaperScene>& scenes);

}  // namespace hemitex::cli
