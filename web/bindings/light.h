/// Solutions by progressive refinement for JavaScript.
#pragma once

#include "web/bindings/scenes.h"

namespace hemitex::web {

/// A Solution of the elements, with SolveSettings; see web/page/core.ts.
Value solve(const ElementsHandle& elements, const Value& settings);

}  // namespace hemitex::web
