/// Makes the page report.html of a solved scene from cli/view/report.html: the lit room in 3-D, where the flux went,
/// the convergence of the solution, its settings and warnings. The page works without a network.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/form_factors/back_absorption.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The progress of a solution: one entry per shot.
struct Convergence {
  std::vector<double> residual;  ///< unshot over emitted flux after the shot
  std::vector<double> seconds;   ///< since the start of the solution
};

/// What is known while a scene is solved, and not kept in its folder.
struct SolveRecord {
  Convergence convergence;
  radiosity::BackAbsorption backs;
  std::vector<glm::dvec3> lostToBacks;  ///< one per surface: flux that it shot and that backs absorbed
};

/// `lit` is the lit scene, `solution` the object of solution.json, and `surfaceOf` holds for each surface of `lit` its
/// number in solution["surfaces"]. Only the element `times` of the page depends on time. Writes temporary files into
/// `folder`, which exists.
std::string solvedPage(const radiosity::Scene& lit, const std::vector<std::uint32_t>& surfaceOf,
                       const radiosity::Camera& camera, const nlohmann::ordered_json& solution,
                       const std::optional<SolveRecord>& record, const std::filesystem::path& folder);

}  // namespace hemitex::cli
