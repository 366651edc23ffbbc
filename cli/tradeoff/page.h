/// The page of `hemitex tradeoff`, cli/tradeoff/report.html with its numbers and pictures (cli/report/html_page.h).
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
std::string tradeoffPage(const Tradeoff& tradeoff, const radiosity::Camera& camera, nlohmann::ordered_json result,
                         const std::filesystem::path& folder);

}  // namespace hemitex::cli
