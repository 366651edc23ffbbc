#include "reference/rows/solution_rows.h"

#include <cstdint>
#include <map>
#include <utility>

#include "raster/base/parallel.h"
#include "reference/rows/facet_form_factors.h"

namespace hemitex::reference {
namespace {

class BoundedRows {
 public:
  BoundedRows(const radiosity::Scene& scene, const radiosity::Discretization& discretization, double maxError,
              RowErrors errors)
      : discretization_(discretization), factors_(scene, {maxError}), errors_(std::move(errors)) {
    errors_->assign(scene.surfaces.size(), 0);
  }

  radiosity::FormFactorRow row(const radiosity::Patch& patch) {
    const auto known = ahead_.find(patch.surface);
    SparseRow found = known == ahead_.end() ? factors_.row(patch.surface) : std::move(known->second);
    if (known != ahead_.end()) ahead_.erase(known);  // the solution keeps rows
    (*errors_)[patch.surface] = *found.rowError;
    const OutsideShares outside = found.takeOutside(errors_->size());
    std::vector<std::uint32_t> elements;
    for (const std::uint32_t surface : found.column) elements.push_back(discretization_.grids[surface].firstElement);
    return radiosity::closedRow(elements, found.value, *outside.surroundings, *outside.backs);
  }

  /// Computes rows of facets that will probably shoot soon, if that of the next one is missing.
  void lookAhead(const radiosity::Step& step) {
    constexpr std::size_t rowsAtOnce = 64;
    if (step.isLast) return;
    std::vector<std::uint32_t> missing;
    for (const radiosity::LikelyShot& shot : step.likelyShots(rowsAtOnce)) {
      const std::uint32_t surface = step.patches.list[shot.patch].surface;
      if (!ahead_.contains(surface))
        missing.push_back(surface);
      else if (missing.empty())
        return;
    }
    std::vector<SparseRow> rows(missing.size());
    raster::parallelFor(missing.size(), [&](std::size_t r) { rows[r] = factors_.row(missing[r]); });
    for (std::size_t r = 0; r < missing.size(); ++r) ahead_[missing[r]] = std::move(rows[r]);
  }

 private:
  const radiosity::Discretization& discretization_;
  FacetFormFactors factors_;
  std::map<std::uint32_t, SparseRow> ahead_;  ///< by surface
  RowErrors errors_;
};

}  // namespace

radiosity::OtherRows rayRows(const RayRowSettings& settings) {
  return [settings](const radiosity::PatchRows& drawn, const radiosity::Scene& scene,
                    const radiosity::Discretization& discretization) {
    const auto rays = std::make_shared<RayRows>(scene, discretization, settings);
    return radiosity::PatchRows{.rowOf = [rays](const radiosity::Patch& patch) { return rays->ofPatch(patch); },
                                .split = drawn.split};
  };
}

radiosity::OtherRows boundedRows(double maxError, RowErrors errors) {
  return [maxError, errors = std::move(errors)](const radiosity::PatchRows&, const radiosity::Scene& scene,
                                                const radiosity::Discretization& discretization) {
    const auto rows = std::make_shared<BoundedRows>(scene, discretization, maxError, errors);
    return radiosity::PatchRows{.rowOf = [rows](const radiosity::Patch& patch) { return rows->row(patch); },
                                .prepare = [rows](const radiosity::Step& step) { rows->lookAhead(step); }};
  };
}

}  // namespace hemitex::reference
