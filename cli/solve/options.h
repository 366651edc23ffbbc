/// The options of `hemitex solve`: reads them and checks that they do not contradict each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/scene/camera_options.h"
#include "cli/scene/scene_options.h"
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
  std::optional<radiosity::TextureFilter> filter;  ///< see texturesOf for the default
  std::optional<int> magnification;
  CameraOptions camera;
  std::filesystem::path edits;  ///< empty if there are none
  bool report = false;          ///< also write report.html
  std::filesystem::path output;
};

/// Adds the options to the command. `options` must outlive the program.
void addSolveOptions(Command command, SolveOptions& options);

/// Completes and checks the options after the whole command line is read: sets the projection, and throws a usage error
/// for contradicting options.
void completeOptions(Command command, SolveOptions& options);

bool usesRays(const SolveOptions& options);

/// The given settings of textures, or their defaults. Filters that interpolate between texels are visible only with
/// magnification, so they have a default above 1.
radiosity::TextureSettings texturesOf(const SolveOptions& options);
/// The name of a filter, as for `--filter`.
std::string nameOf(radiosity::TextureFilter filter);

}  // namespace hemitex::cli
