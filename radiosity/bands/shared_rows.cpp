#include "radiosity/bands/shared_rows.h"

#include <cassert>
#include <optional>
#include <utility>

#include "radiosity/form_factors/row_cache.h"

namespace hemitex::radiosity {

std::vector<Solution> solveWithSameRows(std::size_t count, Patches patches, const InputOf& inputOf,
                                        const Progress& progress) {
  assert(count > 0);
  std::vector<Solution> solutions;
  std::optional<RowCache> rows;
  bool goesOn = true;
  for (std::size_t i = 0; i < count; ++i) {
    SolveInput input = inputOf(i);
    if (!rows) rows.emplace(input.settings.rowCacheBytes);
    // Rows are kept by the numbers of patches. A patch that has a row is not split any more.
    input.rows = &*rows;
    input.patches = std::move(patches);
    solutions.push_back(solve(std::move(input), [&](const Step& step) {
      goesOn = goesOn && (!progress || progress(step));
      return goesOn;
    }));
    patches = std::move(solutions.back().patches);
  }
  solutions.back().patches = std::move(patches);
  return solutions;
}

}  // namespace hemitex::radiosity
