/// The page of `hemitex tradeoff`: one HTML file with its plots (Chart.js), its numbers and its pictures inside, so
/// that it opens anywhere without a network. The page itself is tradeoff_page.html.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/tradeoff/files.h"
#include "radiosity/pictures/camera.h"

namespace hemitex::cli {

/// `result` is the object of tradeoff.json. Pictures show the truth, and where the errors sit of three choices on the
/// Pareto front: the fastest, one in the middle, the most exact. They are written into `folder` on the way, and
/// removed.
std::string tradeoffPage(const Tradeoff& tradeoff, const radiosity::Camera& camera,
                         const nlohmann::ordered_json& result, const std::filesystem::path& folder);

}  // namespace hemitex::cli
