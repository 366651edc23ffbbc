/// Writes the measurements of `hemitex tradeoff` as JSON, CSV, Markdown and HTML.
///
/// tradeoff.json holds:
///
/// - `scene`: the name of its file; `settings`; `warnings`;
/// - `truth`: `elements`, and its expected statistical errors `radiosity_error` and `row_error`;
/// - `choices`: one object per choice, with the keys
///
///       method, setting, value     the method, the name of its setting, and the value
///       directions                 pixels or rays per row
///       texels, patch              texels along a surface's side, and along a patch's side
///       elements, patches, rows, shots   rows: number of patches that shot
///       row_error                  relative_l1, rms, maximum (see reference/truth/solution/row_error.h)
///       radiosity_error            flux_weighted, rms, maximum (see reference/truth/solution/radiosity_error.h)
///       bytes                      buffer, rows, elements (see reference/measurement/tradeoff/tradeoff.h)
///       times                      median_s, rounds_s, and pareto: whether it is on the Pareto front
///
/// - `same_points`: rows of hemicubes and rays from the same points (see
/// reference/measurement/bench/equal_time_error.h),
///   with `points` and `truth_error`. `hemicubes`, `turned_hemicubes` and `rays` are lists of objects with `size`,
///   `error` and `times`: `row_s` and, for hemicubes, `error_of_rays` in the same time, or null. Null if hemicubes or
///   rays are not measured;
/// - `times`: `truth_s`, `all_s`, `threads` (0: all cores), and `within`: for several bounds on the error the index of
///   the fastest choice, or null.
///
/// Except for the keys `times`, every run gives the same file. tradeoff.csv has one line per choice.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/table.h"
#include "radiosity/pictures/camera.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/tradeoff/tradeoff.h"

namespace hemitex::cli {

/// The measurements and their scene.
struct Tradeoff {
  const radiosity::Scene& scene;
  const radiosity::Discretization& fine;  ///< the elements of the truth
  const reference::TrueRadiosity& truth;
  const std::vector<reference::TradeMethod>& methods;
  std::vector<reference::TradeMeasurement> measurements;
  reference::RowError truthRowError;
  std::optional<reference::RowComparison> samePoints;  ///< of hemicubes and rays, if both are measured
};

/// An object with `truth`, `choices`, `same_points` and `times`.
nlohmann::ordered_json toJson(const Tradeoff& tradeoff);
/// The table of tradeoff.csv from the list `choices`, with its values in the same order and the number of rounds.
Table choiceTable(const nlohmann::ordered_json& choices);
/// The table of the fastest choices in Markdown.
std::string tradeoffText(const nlohmann::ordered_json& result);

/// The page report.html. `result` is the object of tradeoff.json. The pictures show the truth and the errors of three
/// choices on the Pareto front: the fastest, the middle and the most accurate.
std::string tradeoffPage(const Tradeoff& tradeoff, const radiosity::Camera& camera, nlohmann::ordered_json result);

}  // namespace hemitex::cli
