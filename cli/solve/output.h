/// The output of `hemitex solve`: the folder of a lit scene, its solution.json and the summary for people.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/report/solved_page.h"
#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/lit_scene.h"

namespace hemitex::cli {

/// A solution, and what it was computed from.
struct SolvedScene {
  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  const radiosity::IdLayout& layout;
  const radiosity::Solution& solution;
};

/// How solutions are shown, equal for all frames.
struct Display {
  const SolveOptions& options;  ///< including settings chosen for --max-error
  const radiosity::Camera& camera;
  double exposure;
};

/// The given exposure, or the default for the solution.
double exposureOf(const SolveOptions& options, const SolvedScene& solved);

/// The lit scene, with the display textures of the options; nothing with --no-textures.
std::optional<radiosity::LitScene> shownScene(const SolvedScene& solved, const Display& display);

/// Writes the lit scene if there is one, its picture and elements.csv, but not solution.json. Returns warnings for the
/// user.
std::vector<std::string> writeSolved(const std::filesystem::path& folder, const SolvedScene& solved,
                                     const std::optional<radiosity::LitScene>& shown, const Display& display);

/// What only the page of the solution shows: its convergence, and the flux that backs absorbed, by surface.
SolveRecord recordOf(const SolvedScene& solved, const SolveOptions& options, const Convergence& convergence);

/// Writes the page of a folder after writeSolved. `solution` is the object of solution.json, and `shown` the lit scene.
void writeReport(const std::filesystem::path& folder, const radiosity::LitScene& shown,
                 const nlohmann::ordered_json& solution, const SolveRecord& record);

/// The settings that a solution depends on, but not those for showing it.
nlohmann::ordered_json solutionSettings(const SolveOptions& options);

/// The object of solution.json without times and warnings: the settings that the result depends on, and the solution.
/// It contains no path and no thread count, so that equal results have equal files.
nlohmann::ordered_json description(const SolvedScene& solved, const Display& display);

/// The summary of solution.json for people: counts, times, residual, expected error and the balance of flux.
std::string summary(const nlohmann::ordered_json& solution);
/// Says where the files are.
std::string filesText(const SolveOptions& options);

}  // namespace hemitex::cli
