/// Explains the item ID of one pixel by the raster rules, step by step, in JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "raster/interface/face.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// The view of a face: `eye`, `x`, `y`, `w`, `near`, `resolution`.
nlohmann::ordered_json viewOf(const raster::Face& face);

/// The item ID of pixel (column, row) in the viewport of a face: an object with the keys `face`, `column`, `row`,
/// `word` (the item ID), `from` (its draw and texel), `derivation` (null for the background) and `triangles`, those
/// that cover the sample, nearest first. Throws InputError for a pixel outside the scissor rectangle.
///
/// The derivation has every number from the vertices to the blend, which a reader can check by hand: exact values that
/// are rounded once to binary64. It is an object with the keys
///
/// - `triangle`, `draw`, `vertices` (`index`, `position`, `from_eye`, `view`, `texcoord`),
/// - `clip` (`cut_by`, `piece`, `pieces`), `corners` (`view`, `texcoord`, `q`, `snapped`),
/// - `sample`, `area`, `faces_away`, `edges` (`value`, `kind`), `weights`, `inverse_depth`, `u`, `v`,
/// - `texel` (`width`, `height`, `position`, `column`, `row`, `index`; null where there is none),
/// - `sums` (`bits`, `offset`, `texel`, `result`), `word` (the item ID),
/// - `runner_up` (`triangle`, `draw`, `inverse_depth`, `difference`; null where there is none),
/// - `depth`, also of `runner_up`: z/w or the stored depth; only in clip space and where depths are stored.
nlohmann::ordered_json explanation(const TestVector& vector, const VectorFace& face, int column, int row);

}  // namespace hemitex::reference
