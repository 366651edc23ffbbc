/// The options of `hemitex formfactors`, the method that they choose, and what the output of rows and of matrices
/// shares.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/console.h"
#include "cli/common/program.h"
#include "cli/common/table.h"
#include "cli/devices/row_device.h"
#include "cli/scene/scene_options.h"
#include "reference/rows/scene_rows.h"

namespace hemitex::cli {

struct FormFactorOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  radiosity::IdSettings id;
  std::string method = "hemicube";
  radiosity::DrawingSettings drawing;
  RowDevice device;
  reference::RayOptions rays;
  std::string from;
  std::vector<std::string> at;  ///< points or files of points
  bool bySurface = false;
  bool all = false;
  bool smooth = false;
  bool facets = false;
  std::optional<double> maxError;
  std::filesystem::path output;  ///< empty: standard output
  std::filesystem::path vtu;     ///< of the facets; empty: none
  std::vector<int> vtuRows;      ///< facets whose rows are in that file
};

/// The rows of the method that the options choose.
reference::RowMethod methodOf(const FormFactorOptions& options, const radiosity::Scene& scene,
                              const radiosity::Discretization& discretization, const reference::RowReceivers& receivers,
                              Context& context);

/// The settings that the JSON output repeats.
nlohmann::ordered_json settingsOf(const FormFactorOptions& options);

/// A table with one line per row and receiver: cells that name them, the form factor, and its standard error if there
/// is one.
Table tableOf(const std::vector<reference::SparseRow>& rows, std::size_t receivers, std::vector<std::string> columns,
              const std::function<std::vector<Cell>(std::size_t)>& names);

/// Said where a method has no backs, and no light that leaves the scene.
inline const std::string blockersIgnored = "blockers are not looked at";

/// Says how much of the light a projection captures, if not all.
void tellCaptured(const reference::RowMethod& method, Console& console);

/// Warns of rows of which backs take more than 1 %: faces may be turned over. `backs` has the share of each row.
void warnOfBacks(const std::vector<double>& backs, const std::vector<std::string>& names, Console& console);

}  // namespace hemitex::cli
