/// Makes the page report.html of a solved scene from cli/report/solved.html: the lit room in 3-D, where the flux went,
/// the convergence of the solution, its settings and warnings. The page works without a network.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/light/back_absorption.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The progress of a solution: one entry per shot.
struct Convergence {
  std::vector<double> residual;  ///< unshot over emitted flux after the shot
  std::vector<double> seconds;   ///< since the start of the solution
};

/// A lit scene (radiosity/textures/lit_scene.h), and what is known while it is solved and not kept in its folder.
struct ShownScene {
  std::filesystem::path glb;  ///< the file scene.glb, which the page contains; if it is missing, the page says so
  radiosity::Scene scene;
  std::vector<std::uint32_t> surfaceOf;  ///< one per surface: its number in solution["surfaces"]
  Convergence convergence = {};
  std::optional<radiosity::BackAbsorption> backs = {};  ///< nothing if the scene was solved earlier
  std::vector<glm::dvec3> lostToBacks = {};             ///< one per surface: flux that it shot and that backs absorbed
  std::string version = {};  ///< with it the page loads itself again when watch.js names another one
};

/// `solution` is the object of solution.json. Only the element `times` of the page depends on time. Throws
/// nlohmann::json::exception if the solution does not belong to the scene.
std::string solvedPage(const ShownScene& lit, const nlohmann::ordered_json& solution);

}  // namespace hemitex::cli
