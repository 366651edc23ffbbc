/// solution.json of a solved folder (settings, counts and the balance of flux), and its summary for people.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "radiosity/pictures/camera.h"

namespace hemitex::radiosity {
struct Discretization;
struct GatheredLight;
struct IdLayout;
struct LitScene;
struct Scene;
struct Solution;
}  // namespace hemitex::radiosity

namespace hemitex::cli {

struct SolveOptions;

/// A solution, what it was computed from, and how it is shown.
struct SolvedScene {
  const SolveOptions& options;  ///< including settings chosen for --max-error
  const radiosity::Camera& camera;
  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  const radiosity::IdLayout& layout;
  const radiosity::Solution& solution;
  std::span<const double> rowErrors = {};              ///< see SolveResult
  const radiosity::GatheredLight* gathered = nullptr;  ///< with --gather
};

/// The area of a surface's elements, and means over this area.
struct SurfaceMeans {
  double area = 0;
  glm::dvec3 radiosity{0.0}, reflectance{0.0}, emission{0.0};
};
SurfaceMeans meansOf(const SolvedScene& solved, std::uint32_t surface);

/// The settings that a solution depends on, but not those for showing it.
nlohmann::ordered_json solutionSettings(const SolveOptions& options);

/// The object of solution.json without times and warnings: the name of the scene's file, the settings that the result
/// depends on, and the surfaces with their grids and places in the textures of the lit scene, counts, residual and
/// energy. It contains no path and no thread count, so that equal results have equal files. The options hold the
/// exposure.
nlohmann::ordered_json description(const SolvedScene& solved, const std::optional<radiosity::LitScene>& lit);

/// The summary of solution.json: counts, times, residual, expected error, how emission was read, and the balance of
/// flux.
std::string summary(const nlohmann::ordered_json& solution);

/// A warning if the emitted flux shows that the scene's unit of length is not the metre, and no unit was given.
std::vector<std::string> unitWarning(const SolvedScene& solved);

/// The warnings of a solution. Where it advises surfaces for both sides, it names the option.
std::vector<std::string> warningsOf(const radiosity::Solution& solution);

}  // namespace hemitex::cli
