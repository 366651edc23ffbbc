/// Makes the page report.html of a solved scene from cli/view/report.html: the lit room in 3-D, where the flux went,
/// the convergence of the solution, its settings and warnings. The page works without a network.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/view/room_model.h"
#include "radiosity/form_factors/back_absorption.h"
#include "radiosity/pictures/camera.h"

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

/// `solution` is the object of solution.json; the page knows the surfaces of `lit` by their numbers in
/// solution["surfaces"]. Only the element `times` of the page depends on time.
std::string solvedPage(const ShownScene& lit, const radiosity::Camera& camera, const nlohmann::ordered_json& solution,
                       const std::optional<SolveRecord>& record);

}  // namespace hemitex::cli
