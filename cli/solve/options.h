/// What `hemitex solve` is told: its options, how they are read, and which of them contradict each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/common/camera_options.h"
#include "cli/common/options.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/texture_filter.h"

namespace hemitex::cli {

struct SolveOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  std::optional<double> adaptive;
  radiosity::DrawingSettings drawing;
  std::string method = "hemicube";
  int samples = 1 << 16;
  radiosity::IdSettings id;
  radiosity::SolverSettings solver;
  std::optional<double> maxError;
  std::optional<radiosity::TextureFilter> filter;  ///< see texturesOf for those not asked for
  std::optional<int> magnification;
  CameraOptions camera;
  std::filesystem::path edits;  ///< none: empty
  std::filesystem::path output;
};

/// `options` outlives the line of the program.
void addSolveOptions(Command command, SolveOptions& options);

/// What can only be said when the whole line is read: which projection draws, and what has no use beside what else was
/// given. Throws a usage error.
void completeOptions(Command command, SolveOptions& options);

bool usesRays(const SolveOptions& options);

/// What was asked for, or what suits the elements: filters between texels are seen only where these are magnified.
radiosity::TextureSettings texturesOf(const SolveOptions& options);
/// As `--filter` calls it.
std::string nameOf(radiosity::TextureFilter filter);

}  // namespace hemitex::cli
