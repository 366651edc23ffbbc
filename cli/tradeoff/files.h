/// What `hemitex tradeoff` found, as files: JSON, CSV and a page.
///
/// tradeoff.json: `scene`, the name of its file; `settings`; `truth` (`elements`, `radiosity_error` and `row_error` as
/// expected by chance); `choices`, one object each:
///
///     method, setting, value     the method, and its number with what that is called
///     directions                 pixels or rays a row
///     texels, patch              along a surface's side, and of these along a patch's side
///     elements, patches, rows, shots   rows: patches that shot
///     row_error                  relative_l1, rms, maximum (see reference/solution/row_error.h)
///     radiosity_error            flux_weighted, rms, maximum (see reference/solution/radiosity_error.h)
///     bytes                      buffer, rows, elements (see reference/tradeoff/tradeoff.h)
///     times                      median_s, rounds_s, and what depends on them: pareto, whether it is on the front
///
/// `same_points`: rows of hemicubes and rays from the same points (see reference/bench/equal_time_error.h): `points`,
/// `truth_error`, and in `hemicubes`, `turned_hemicubes` and `rays` objects with `size`, `error` and `times` (`row_s`,
/// and of hemicubes `error_of_rays` in the same time, or null); null where one of the two is not measured. `warnings`.
/// And `times`: `truth_s`, `all_s`, `threads` (0: all), and `within`, for some errors the number of the fastest choice
/// that is at most so far off, or null. Without what is named `times` it is the same for every run.
///
/// tradeoff.csv: the choices, one a line.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/table.h"
#include "reference/bench/equal_time_error.h"
#include "reference/tradeoff/tradeoff.h"

namespace hemitex::cli {

/// What was measured, of which scene.
struct Tradeoff {
  const radiosity::Scene& scene;
  const radiosity::Discretization& fine;  ///< the elements of the truth
  const reference::TrueRadiosity& truth;
  const std::vector<reference::TradeMethod>& methods;
  std::vector<reference::TradeMeasurement> measurements;
  reference::RowError truthRowError;
  std::optional<reference::RowComparison> samePoints;  ///< of hemicubes and rays, where both are measured
};

/// `truth`, `choices`, `same_points` and `within`.
nlohmann::ordered_json toJson(const Tradeoff& tradeoff);
/// Of the list `choices` of that object: the CSV has its values in the same order, and the number of rounds.
Table choiceTable(const nlohmann::ordered_json& choices);
/// The fastest choices of that object, in Markdown.
std::string tradeoffText(const nlohmann::ordered_json& result);

}  // namespace hemitex::cli
