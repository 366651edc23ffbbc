/// Draws the pictures of `hemitex paper`: all panels of Figures 2, 3 and 4 of Nielsen and Christensen (2002), and two
/// pictures for statements of its text.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/measurement/paper/scenes.h"

namespace hemitex::cli {

/// Called before each part with its name.
using PictureProgress = std::function<void(const std::string& what)>;

/// Writes the pictures into `folder` as PNG files and returns a list of `{figure, panel, file, caption}`. `figure` is
/// 2, 3 or 4, or 0 for pictures that the paper does not have. The scenes `simple` and `complex` are solved at their
/// medium levels; other scenes come from the scene folder.
nlohmann::ordered_json writePaperFigures(const std::filesystem::path& sceneFolder,
                                         const std::vector<reference::PaperScene>& scenes,
                                         const std::filesystem::path& folder, const PictureProgress& progress);

/// Counts the phantom indices of the medium levels for each use of index maps. Returns a list of
/// `{scene, index_maps, offsets, words, spare_texels, alignment_gaps}` (see radiosity/index_maps/phantom_indices.h).
/// `words` is the number of item IDs.
nlohmann::ordered_json phantomsJson(const std::vector<reference::PaperScene>& scenes);

}  // namespace hemitex::cli
