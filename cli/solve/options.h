/// The options of `hemitex solve`: reads them and checks that they do not contradict each other.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/devices/row_device.h"
#include "cli/scene/camera_options.h"
#include "cli/scene/scene_options.h"
#include "cli/solve/checkpoint.h"
#include "radiosity/ranks/messenger.h"
#include "radiosity/solver/error_control.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/texture_filter.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::cli {

struct SolveOptions {
  SceneOptions scene;
  std::optional<double> metresPerUnit;  ///< the unit of the scene's lengths; a metre if neither given nor in the file
  radiosity::DiscretizationSettings discretization;
  std::optional<double> adaptive;
  radiosity::DrawingSettings drawing;
  RowDevice device;
  RendererMaker makeRenderer = radiosity::softwareRenderer;  ///< of the device
  std::string method = "hemicube";
  int samples = 1 << 16;
  std::uint32_t seed = 0;
  radiosity::IdSettings id;
  radiosity::SolverSettings solver;
  std::optional<double> residual;  ///< of `solver`; see radiosity::defaultResidual
  std::optional<double> maxError;
  radiosity::Effort coarsest = radiosity::EffortLimits().coarsest;  ///< as given with maxError
  std::optional<radiosity::TextureFilter> filter;                   ///< see filterOf for the default
  std::optional<int> magnification;                                 ///< see magnificationOf for the default
  CameraOptions camera;
  std::filesystem::path edits;            ///< empty if there are none
  std::filesystem::path bands;            ///< empty: the bands are R, G and B
  bool isContinued = false;               ///< keep what updates of the solution need
  radiosity::Messenger* ranks = nullptr;  ///< the ranks that share rows; null if this process is alone
  bool report = false;                    ///< also write report.html
  bool gather = false;                    ///< textures have gathered light
  bool lightmap = false;                  ///< also write lightmap.glb and light maps
  bool noElements = false;                ///< do not write elements.csv
  bool noTextures = false;                ///< do not write textures, nor the lit scene, which shows them
  bool facets = false, noFacets = false;  ///< as given; the settings of the scene say what is chosen
  std::filesystem::path matrix;           ///< with rows of facets; empty: rows are computed
  LongRunOptions longRun;
  std::filesystem::path output;
};

/// Adds the options to the command. `options` and `context` must outlive the program.
void addSolveOptions(Command command, SolveOptions& options, Context& context);

/// The options with the unit of lengths that the file of the scene states, unless they give one. Appends warnings. The
/// flux of lamps depends on the unit, so that this comes before the scene is read.
SolveOptions withStatedUnit(SolveOptions options, std::vector<std::string>& warnings);

/// Loads the scene in the bands of the options, and changes its materials as they ask: a colour means the bands that it
/// stands for. Its files include those of the bands. Throws InputError as loading, as readBands, and for bands without
/// light.
radiosity::Scene loadedScene(const SolveOptions& options);

/// Completes and checks the options after the whole command line is read: sets the projection, and throws a usage error
/// for contradicting options.
void completeOptions(Command command, SolveOptions& options);

bool usesRays(const SolveOptions& options);
/// Whether rows are drawn: neither cast, nor those of a matrix, nor rows with a bounded error.
bool usesDrawnRows(const SolveOptions& options);
/// Whether --max-error bounds the rows of facets without texels.
bool boundsRows(const SolveOptions& options);
/// Whether --max-error bounds the light, and chooses the effort; otherwise it bounds rows, or the end alone of a
/// matrix.
bool boundsLight(const SolveOptions& options);
/// Whether the light of what the camera sees decides when the solution ends: unless its end is given.
bool followsCamera(const SolveOptions& options);
/// Whether display textures or light maps are written.
bool hasTextures(const SolveOptions& options);
/// Whether scene.vtu shows the facets.
bool writesFacets(const SolveOptions& options);

/// The area of a square unit of the scene in m^2, by which fluxes per square unit become W.
double squareMetresPerUnit(const SolveOptions& options);

/// The given filter of display textures, or the default: cubic B-splines, for quadtrees their own filter.
radiosity::TextureFilter filterOf(const SolveOptions& options);
/// The given magnification of display textures, or the rule for surfaces. One-to-one has no use for more texels.
radiosity::Magnification magnificationOf(const SolveOptions& options);
/// The name of a filter, as for `--filter`.
std::string nameOf(radiosity::TextureFilter filter);

}  // namespace hemitex::cli
