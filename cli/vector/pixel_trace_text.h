/// A derivation (reference/conformance/trace/pixel_trace.h) as JSON, and that JSON as text for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reference/conformance/trace/pixel_trace.h"

namespace hemitex::cli {

/// An object with the keys
///
/// - `triangle`, `draw`, `vertices` (`index`, `position`, `from_eye`, `view`, `texcoord`),
/// - `clip` (`cut_by`, `piece`, `pieces`), `corners` (`view`, `texcoord`, `q`, `snapped`),
/// - `sample`, `area`, `faces_away`, `edges` (`value`, `kind`), `weights`, `inverse_depth`, `u`, `v`,
/// - `texel` (`width`, `height`, `position`, `column`, `row`, `index`; null where there is none),
/// - `sums` (`bits`, `offset`, `texel`, `result`), `word` (the item ID),
/// - `runner_up` (`triangle`, `draw`, `inverse_depth`, `difference`; null where there is none).
nlohmann::ordered_json toJson(const reference::Derivation& derivation);

/// The view of a face: `eye`, `x`, `y`, `w`, `near` and `resolution`.
nlohmann::ordered_json toJson(const raster::Face& face);

/// A line per key, with the formula of its values; lists of objects take a line per entry.
std::string toLines(const nlohmann::ordered_json& steps);

}  // namespace hemitex::cli
