/// What `hemitex solve` writes and prints: the folder of a lit scene, and what its solution.json and people are told of
/// it.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/radiosity_texture.h"

namespace hemitex::cli {

/// A solution, and what it is one of.
struct Lit {
  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  const radiosity::IdLayout& layout;
  const radiosity::Solution& solution;
  std::vector<glm::dvec3> displayed = radiosity::displayRadiosity(scene, discretization, solution);
};

/// How solutions are shown: those of all frames alike.
struct Showing {
  const SolveOptions& options;  ///< with what was chosen for a bound on the error
  const radiosity::Camera& camera;
  double exposure;
};

double exposureOf(const SolveOptions& options, const Lit& lit);

/// Writes the lit scene for any viewer of OBJ files, its picture and its numbers, but for solution.json.
void writeSolved(const std::filesystem::path& folder, const Lit& lit, const Showing& showing);

/// What solution.json says but for times and warnings: the settings that the answer depends on (no path, no thread
/// count), and the solution.
nlohmann::ordered_json description(const Lit& lit, const Showing& showing);

/// What solution.json says, for people: counts, times, and where the flux went.
std::string summary(const nlohmann::ordered_json& solution);

}  // namespace hemitex::cli
