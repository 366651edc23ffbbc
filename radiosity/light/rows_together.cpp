#include "radiosity/light/rows_together.h"

#include <utility>

namespace hemitex::radiosity {
namespace {

/// Rows that are drawn at once.
constexpr std::size_t rowsAtOnce = 64;
/// Rows that are kept; those of patches that shoot later than expected, or from other points, are among them.
constexpr std::size_t rowsKept = 8 * rowsAtOnce;

}  // namespace

void RowsTogether::lookAhead(const NextShots& shots) {
  const std::vector<LikelyShot> next = shots.likely(1);
  if (next.empty() || ahead_.contains(next.front().patch)) return;
  if (ahead_.size() > rowsKept) ahead_.clear();
  std::vector<std::uint32_t> patches;
  std::vector<std::vector<ViewPoint>> points;
  for (const LikelyShot& shot : shots.likely(rowsAtOnce)) {
    if (shot.weight == 0) break;  // its row will have another resolution, as will those of the rest
    if (ahead_.contains(shot.patch)) continue;
    std::vector<ViewPoint> likely = formFactors_.likelyPoints(shots.patches, shots.patches.list[shot.patch], shot.weight);
    if (likely.empty() && patches.empty()) return;  // the next patch is split first
    if (likely.empty()) continue;
    patches.push_back(shot.patch);
    points.push_back(std::move(likely));
  }
  std::vector<FormFactorRow> rows = formFactors_.uncorrected().ofManyPoints(points);
  for (std::size_t r = 0; r < rows.size(); ++r) ahead_[patches[r]] = {std::move(points[r]), std::move(rows[r])};
}

FormFactorRow RowsTogether::row(const Patch& patch) {
  const std::vector<ViewPoint> points = formFactors_.uncorrected().pointsOfPatch(patch);
  const auto known = ahead_.find(patch.number);
  FormFactorRow drawn = known != ahead_.end() && known->second.points == points
                            ? std::move(known->second.row)
                            : formFactors_.uncorrected().ofPoints(points);
  if (known != ahead_.end()) ahead_.erase(known);  // the solution keeps rows
  return formFactors_.corrected(patch, drawn).value_or(std::move(drawn));
}

}  // namespace hemitex::radiosity
