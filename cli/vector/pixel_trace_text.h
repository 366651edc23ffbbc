/// A derivation (reference/trace/pixel_trace.h) as text for people, and as JSON with the same numbers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reference/trace/pixel_trace.h"

namespace hemitex::cli {

/// Lines from the vertex stage to the item ID. `list` and `face` are what was derived from.
std::string toText(const reference::Derivation& derivation, const raster::DrawList& list, const raster::Face& face);

/// An object with the keys `triangle`, `draw`, `vertices` (`index`, `position`, `from_eye`, `view`, `texcoord`), `clip`
/// (`cut_by`, `piece`, `pieces`), `corners` (`view`, `texcoord`, `q`, `snapped`), `sample`, `area`, `faces_away`,
/// `edges`
/// (`value`, `kind`), `weights`, `inverse_depth`, `u`, `v`, `texel` (`width`, `height`, `position`, `column`, `row`,
/// `index`; null where there is none), `sums` (`bits`, `offset`, `texel`, `result`), `id` and `runner_up`
/// (`triangle`, `draw`, `inverse_depth`, `difference`; null where there is none).
nlohmann::ordered_json toJson(const reference::Derivation& derivation);

}  // namespace hemitex::cli
