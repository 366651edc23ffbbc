/// Makes the HTML page of `hemitex tradeoff` from cli/tradeoff/report.html, numbers and pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/tradeoff/files.h"
#include "radiosity/pictures/camera.h"

namespace hemitex::cli {

/// `result` is the object of tradeoff.json. The pictures show the truth and the errors of three choices on the Pareto
/// front: the fastest, the middle and the most accurate. Writes temporary files into `folder`.
std::string tradeoffPage(const Tradeoff& tradeoff, const radiosity::Camera& camera, nlohmann::ordered_json result,
                         const std::filesystem::path& folder);

}  // namespace hemitex::cli
