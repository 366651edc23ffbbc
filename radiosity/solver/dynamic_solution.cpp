#include "radiosity/solver/dynamic_solution.h"

#include <algorithm>

#include "radiosity/discretization/edited_discretization.h"
#include "radiosity/discretization/grid_size.h"
#include "radiosity/form_factors/row_update.h"

namespace hemitex::radiosity {
namespace {

std::uint32_t viewCount(const Patch& patch) {
  return patch.points > 1 ? static_cast<std::uint32_t>(patch.points * patch.points) : 0;
}

/// The cache key of a view: no patch has more than 2^8 views.
std::uint64_t viewNumber(std::uint32_t patch, std::uint32_t view) {
  static_assert(maxSplits <= 4);
  return (std::uint64_t{patch} << 8) + view;
}

/// The largest stale light that one update may leave, as a share of what the residual still allows. It remains in all
/// later frames.
constexpr double shareLeftStale = 0.1;
/// The solution starts again when stale light exceeds this share of what the residual allows: after about ten frames.
constexpr double maxStale = 0.7;

/// The numbers of surfaces, patches and elements after an edit. Removed patches have none; removed elements share one
/// number behind all others.
struct Renumbering {
  std::vector<std::optional<std::uint32_t>> patch;  ///< one per former patch; none if its surface was moved or removed
  std::vector<std::uint32_t> element;               ///< one per former element
  std::vector<bool> isGone,
      isCome;  ///< one per former surface, and one per new surface: absent in the other scene, or moved
};

Renumbering renumber(const Discretization& before, const Discretization& after, const std::vector<Origin>& origins) {
  Renumbering numbers;
  numbers.patch.resize(before.patches.list.size());
  numbers.element.assign(before.elements.size(), static_cast<std::uint32_t>(after.elements.size()));
  numbers.isGone.assign(before.grids.size(), true);
  numbers.isCome.assign(after.grids.size(), true);
  const auto patchesBefore = patchesOfSurfaces(before.patches, before.grids.size()),
             patchesAfter = patchesOfSurfaces(after.patches, after.grids.size());
  for (std::size_t s = 0; s < origins.size(); ++s) {
    if (!origins[s].former) continue;
    const Grid& old = before.grids[*origins[s].former];
    const Grid& grid = after.grids[s];
    for (std::uint32_t e = 0; e < grid.elementCount; ++e) numbers.element[old.firstElement + e] = grid.firstElement + e;
    if (origins[s].isMoved) continue;
    numbers.isGone[*origins[s].former] = numbers.isCome[s] = false;
    const std::vector<std::uint32_t>& now = patchesAfter[s];
    for (std::size_t p = 0; p < now.size(); ++p) numbers.patch[patchesBefore[*origins[s].former][p]] = now[p];
  }
  return numbers;
}

/// A row of a former scene in new numbers. They ascend like the old ones, except those of removed elements.
FormFactorRow inNewNumbers(const FormFactorRow& row, const Renumbering& numbers, std::uint32_t gone) {
  FormFactorRow result{{}, {}, row.background, row.back};
  std::uint64_t atGone = 0;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t element = numbers.element[row.elements[i]];
    if (element == gone) {
      atGone += row.shares[i];
      continue;
    }
    result.elements.push_back(element);
    result.shares.push_back(row.shares[i]);
  }
  if (atGone > 0) {
    result.elements.push_back(gone);
    result.shares.push_back(atGone);
  }
  return result;
}

/// Adds flux along a row to the received flux; negative flux retracts.
void receive(ShotLight& light, const FormFactorRow& row, std::span<const double> flux) {
  for (std::size_t i = 0; i < row.elements.size(); ++i)
    addTo(light.received[row.elements[i]], flux, formFactor(row.shares[i]));
  addTo(light.lost, flux, formFactor(row.background + row.back));
  addTo(light.lostToBacks, flux, formFactor(row.back));
}

/// The patches that keep their old rows: those with the smallest bounds of stale light, as many as allowed.
struct LeftRows {
  std::vector<bool> isLeft;  ///< one per former patch
  double stale = 0;
};

LeftRows leaveRows(const std::vector<double>& bounds, double allowed) {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t p = 0; p < bounds.size(); ++p)
    if (bounds[p] > 0) order.emplace_back(bounds[p], p);
  std::sort(order.begin(), order.end());
  LeftRows left{std::vector<bool>(bounds.size())};
  for (const auto& [bound, patch] : order) {
    if (left.stale + bound > allowed) break;
    left.stale += bound;
    left.isLeft[patch] = true;
  }
  return left;
}

/// The row of a patch before its correction, from the cached rows of its views.
FormFactorRow drawnByViews(ProjectedFormFactors& rows, RowCache& ofViews, const Patch& patch) {
  if (viewCount(patch) == 0) {
    const FormFactorRow* known = ofViews.find(viewNumber(patch.number, 0));
    return known != nullptr ? *known : rows.ofPatch(patch);
  }
  const std::vector<View> views = rows.viewsOfPatch(patch);
  if (views.size() == 1) return rows.ofView(views.front());
  std::vector<WeightedRow> weighted;
  for (std::uint32_t view = 0; view < views.size(); ++view) {
    const auto drawn = [&] { return rows.ofView(views[view]); };
    weighted.push_back({ofViews.row(viewNumber(patch.number, view), drawn), views[view].area});
  }
  return meanOf(weighted);
}

/// A row in new numbers with part of it exchanged, or drawn anew.
FormFactorRow changed(const FormFactorRow& known, const FormFactorRow& less, const RowChange& change) {
  if (change.isWhole) return change.after;
  return change.isNothing() ? known : exchanged(known, less, change.after);
}

/// Updates the shot light and the cached rows for an edit.
class LightUpdate {
 public:
  LightUpdate(DrawnScene& before, DrawnScene& after, const std::vector<Origin>& origins, KeptRows& kept,
              std::size_t rowCacheBytes)
      : before_(before),
        after_(after),
        numbers_(renumber(before.discretization, after.discretization, origins)),
        gone_(static_cast<std::uint32_t>(after.discretization.elements.size())),
        change_{before.drawn.uncorrected(), after.drawn.uncorrected(), ChangedSurfaces(before.scene, numbers_.isGone),
                ChangedSurfaces(after.scene, numbers_.isCome)},
        kept_(kept),
        rows_{RowCache(rowCacheBytes / 2), RowCache(rowCacheBytes / 2)} {
    areOthersSmall_ = areSmallOnesOther();
  }

  /// `outside` is the flux from outside after the edit, `mayLeave` the flux that may become stale.
  void update(const ShotLight& light, OutsideFlux outside, double mayLeave) {
    carry(light, std::move(outside));
    const std::vector<double> shares = largestShares();
    std::vector<double> bounds(shares.size());
    std::vector<bool> isCorrected(shares.size());
    for (std::uint32_t p = 0; p < shares.size(); ++p) {
      isCorrected[p] = !areZero(light.shot[p]) && mayBeCorrected(p);
      // The bound holds for what is drawn, not for its correction.
      if (!isCorrected[p]) bounds[p] = 2 * shares[p] * sizeSum(light.shot[p]);
    }
    const LeftRows left = leaveRows(bounds, mayLeave);
    light_.stale += left.stale;
    for (std::uint32_t p = 0; p < shares.size(); ++p) {
      if (!numbers_.patch[p])
        takeBack(p, light.shot[p]);
      else if (isCorrected[p])
        redirectCorrected(p, light.shot[p]);
      else if (isUnchanged(p, shares[p]))
        keep(p);
      else if (left.isLeft[p])
        ++cost_.rowsLeft;
      else if (bounds[p] > 0)
        redirect(p, light.shot[p]);
    }
    // Stale rows may have sent light to removed elements: it counts as lost.
    addTo(light_.lost, light_.received[gone_]);
    light_.received.resize(gone_);
  }

  /// Whether no object was added, removed or moved.
  bool isSameGeometry() const { return change_.gone.empty() && change_.come.empty(); }

  /// Keeps the unchanged rows, but nothing of the shot light.
  void keepRows() {
    const std::vector<double> shares = largestShares();
    for (std::uint32_t p = 0; p < shares.size(); ++p)
      if (numbers_.patch[p] && isUnchanged(p, shares[p])) keep(p);
  }

  ShotLight& light() { return light_; }
  KeptRows& rows() { return rows_; }
  const UpdateCost& cost() const { return cost_; }

 private:
  void carry(const ShotLight& light, OutsideFlux outside) {
    light_ = {BandTable(after_.discretization.patches.list.size(), light.shot.bands),
              BandTable(gone_ + 1, light.shot.bands),
              light.lost,
              light.lostToBacks,
              light.stale,
              light.lastEmitted};
    for (std::size_t p = 0; p < light.shot.size(); ++p)
      if (numbers_.patch[p]) set(light_.shot[*numbers_.patch[p]], light.shot[p]);
    for (std::size_t e = 0; e < light.received.size(); ++e)
      addTo(light_.received[numbers_.element[e]], light.received[e]);
    for (std::size_t e = 0; e < light.outside.received.size(); ++e)
      addTo(light_.received[numbers_.element[e]], light.outside.received[e], -1);
    for (std::size_t e = 0; e < outside.received.size(); ++e) addTo(light_.received[e], outside.received[e]);
    addTo(light_.lost, light.outside.lost, -1);
    addTo(light_.lost, outside.lost);
    addTo(light_.lostToBacks, light.outside.lostToBacks, -1);
    addTo(light_.lostToBacks, outside.lostToBacks);
    light_.outside = std::move(outside);
  }

  /// Bounds of the share of each former patch's light through pixels that can change.
  std::vector<double> largestShares() const {
    std::vector<double> shares(before_.discretization.patches.list.size());
    if (isSameGeometry()) return shares;
    for (std::uint32_t p = 0; p < shares.size(); ++p) {
      if (!numbers_.patch[p]) continue;  // all its shots are retracted
      const Patch& patch = patchBefore(p);
      const double pixel = pixelAngle(change_.rowsAfter.projection()) * (1 << patch.halvings);
      for (const ViewPoint& from : change_.rowsBefore.pointsOfPatch(patch))
        shares[p] = std::max(shares[p], std::min(1.0, change_.gone.largestShare(from.point, pixel) +
                                                          change_.come.largestShare(from.point, pixel)));
      // The change of a pixel may change the map of a whole surface (see level_of_detail.h).
      if (shares[p] > 0 && !change_.rowsAfter.isSumOfWindows()) shares[p] = 1;
    }
    return shares;
  }

  /// Whether an element counts as small in one of the scenes alone.
  bool areSmallOnesOther() const {
    const NearReceivers *before = before_.drawn.near(), *after = after_.drawn.near();
    if (!before || !after) return false;
    for (std::uint32_t e = 0; e < numbers_.element.size(); ++e)
      if (numbers_.element[e] != gone_ && before->isSmall(e) != after->isSmall(numbers_.element[e])) return true;
    return false;
  }

  /// Whether a patch that stays emits light in one of the scenes alone.
  bool isLampOnce(std::uint32_t patch) const {
    const NearReceivers *before = before_.drawn.near(), *after = after_.drawn.near();
    return before && after && numbers_.patch[patch] &&
           before->isLamp(patchBefore(patch)) !=
               after->isLamp(after_.discretization.patches.list[*numbers_.patch[patch]]);
  }

  /// Whether the row of a patch that stays may be corrected, before or after the edit.
  bool mayBeCorrected(std::uint32_t patch) {
    NearReceivers* before = before_.drawn.near();
    if (isLampOnce(patch)) return true;
    if (!before || isSameGeometry() || !numbers_.patch[patch]) return false;
    if (areOthersSmall_) return true;
    const Patch& old = patchBefore(patch);
    if (before->known().of(patch) == NearRows::State::Unknown) before->corrected(old, drawnBefore(patch));
    if (before->known().of(patch) == NearRows::State::Corrected) return true;
    const glm::dvec3 centre = change_.rowsBefore.pointsOfPatch(old).front().point.position;
    return std::min(change_.gone.distanceFrom(centre), change_.come.distanceFrom(centre)) < before->distanceOf(old);
  }

  /// Whether the row of a patch that shot nothing, or that is not corrected, is unchanged.
  bool isUnchanged(std::uint32_t patch, double share) const {
    NearReceivers* before = before_.drawn.near();
    if (share > 0 || areOthersSmall_ || isLampOnce(patch)) return false;
    return !before || isSameGeometry() || before->known().of(patch) == NearRows::State::Drawn;
  }

  const Patch& patchBefore(std::uint32_t number) const { return before_.discretization.patches.list[number]; }

  FormFactorRow renumbered(const FormFactorRow& row) const { return inNewNumbers(row, numbers_, gone_); }

  /// The drawn row of a former patch, if it is in a cache as a whole.
  const FormFactorRow* knownDrawn(std::uint32_t patch) const {
    NearReceivers* near = before_.drawn.near();
    if (!near || near->known().of(patch) == NearRows::State::Drawn) return kept_.ofPatches.find(patch);
    return viewCount(patchBefore(patch)) == 0 ? kept_.ofViews.find(viewNumber(patch, 0)) : nullptr;
  }

  FormFactorRow drawnBefore(std::uint32_t patch) {
    if (const FormFactorRow* known = knownDrawn(patch)) return *known;
    return drawnByViews(change_.rowsBefore, kept_.ofViews, patchBefore(patch));
  }

  /// The row is unchanged, and so are the rows of its views.
  void keep(std::uint32_t patch) {
    const std::uint32_t number = *numbers_.patch[patch];
    if (NearReceivers* before = before_.drawn.near(), *after = after_.drawn.near(); before && after)
      after->known().set(number, before->known().of(patch));
    if (const FormFactorRow* known = kept_.ofPatches.find(patch)) rows_.ofPatches.keep(number, renumbered(*known));
    keepViews(patch, RowChange());
  }

  /// Keeps the rows of views of which no change, or one each, is given.
  void keepViews(std::uint32_t patch, const RowChange& change) {
    // A patch has no view of parts without area.
    const std::uint32_t views = change.views.empty() ? std::max(1u, viewCount(patchBefore(patch)))
                                                     : static_cast<std::uint32_t>(change.views.size());
    for (std::uint32_t view = 0; view < views; ++view)
      keepView(patch, view, change.views.empty() ? RowChange() : change.views[view]);
  }

  void keepView(std::uint32_t patch, std::uint32_t view, const RowChange& change) {
    const FormFactorRow* known = kept_.ofViews.find(viewNumber(patch, view));
    const std::uint64_t number = viewNumber(*numbers_.patch[patch], view);
    if (change.isWhole)
      rows_.ofViews.keep(number, change.after);
    else if (known != nullptr)
      rows_.ofViews.keep(number, changed(renumbered(*known), renumbered(change.before), change));
  }

  /// Retracts the shots of a patch that was moved or removed.
  void takeBack(std::uint32_t patch, std::span<const double> shot) {
    if (areZero(shot)) return;
    const FormFactorRow* known = kept_.ofPatches.find(patch);
    receive(light_,
            renumbered(known != nullptr ? *known : rowByViews(before_.drawn, kept_.ofViews, patchBefore(patch))),
            scaled(shot, -1));
    ++cost_.rowsRetracted;
  }

  /// Counts the change of a drawn row.
  void count(const RowChange& change) { ++(change.isWhole ? cost_.rowsWhole : cost_.rowsInWindows); }

  /// As redirect for a patch whose row may be corrected: the correction of the drawn row is computed again.
  void redirectCorrected(std::uint32_t patch, std::span<const double> shot) {
    const std::uint32_t number = *numbers_.patch[patch];
    const Patch &old = patchBefore(patch), &now = after_.discretization.patches.list[number];
    const FormFactorRow drawn = drawnBefore(patch);
    const RowChange change = changeOf(change_, old, now, &drawn);
    FormFactorRow drawnAfter;
    if (viewCount(old) == 0 || change.isWhole) {
      drawnAfter = changed(renumbered(drawn), renumbered(change.before), change);
      if (viewCount(old) == 0) rows_.ofViews.keep(viewNumber(number, 0), drawnAfter);
    } else {
      keepViews(patch, change);
      drawnAfter = drawnByViews(change_.rowsAfter, rows_.ofViews, now);
    }
    const FormFactorRow before = renumbered(before_.drawn.corrected(old, drawn).value_or(drawn));
    const FormFactorRow after = after_.drawn.corrected(now, drawnAfter).value_or(drawnAfter);
    if (!change.isNothing()) count(change);
    rows_.ofPatches.keep(number, after);
    if (before == after) return;
    receive(light_, before, scaled(shot, -1));
    receive(light_, after, shot);
  }

  /// Redirects the shot light of a patch along the change of its row.
  void redirect(std::uint32_t patch, std::span<const double> shot) {
    const std::uint32_t number = *numbers_.patch[patch];
    const FormFactorRow* known = knownDrawn(patch);
    const RowChange change = changeOf(change_, patchBefore(patch), after_.discretization.patches.list[number], known);
    if (change.isNothing()) return keep(patch);
    if (NearReceivers* near = after_.drawn.near()) near->known().set(number, NearRows::State::Drawn);
    const FormFactorRow before = renumbered(change.before);
    receive(light_, before, scaled(shot, -1));
    receive(light_, change.after, shot);
    count(change);
    if (change.isWhole)
      rows_.ofPatches.keep(number, change.after);
    else if (known != nullptr && !change.isRounded)
      rows_.ofPatches.keep(number, exchanged(renumbered(*known), before, change.after));
    if (!change.views.empty()) keepViews(patch, change);
  }

  DrawnScene& before_;
  DrawnScene& after_;
  Renumbering numbers_;
  std::uint32_t gone_;  ///< the number of all removed elements
  SceneChange change_;
  bool areOthersSmall_ = false;  ///< see areSmallOnesOther
  KeptRows& kept_;
  KeptRows rows_;
  ShotLight light_;
  UpdateCost cost_;
};

}  // namespace

FormFactorRow rowByViews(SceneFormFactors& drawn, RowCache& ofViews, const Patch& patch) {
  FormFactorRow row = drawnByViews(drawn.uncorrected(), ofViews, patch);
  std::optional<FormFactorRow> corrected = drawn.corrected(patch, row);
  if (!corrected) return row;
  if (viewCount(patch) == 0) ofViews.keep(viewNumber(patch.number, 0), std::move(row));
  return *std::move(corrected);
}

DynamicSolution::DynamicSolution(Scene scene, Discretization discretization, Solution solution,
                                 DynamicSettings settings, LayoutFactory layOut, RendererFactory makeRenderer)
    : settings_(std::move(settings)),
      layOut_(std::move(layOut)),
      makeRenderer_(std::move(makeRenderer)),
      world_(std::make_unique<DrawnScene>(std::move(scene), std::move(discretization), layOut_, settings_.drawing,
                                          makeRenderer_)),
      rows_(std::move(solution.continuation.value().rows)),
      solution_(std::move(solution)) {
  if (NearReceivers* near = world_->drawn.near()) near->known() = std::move(rows_.near);
  settings_.discretization = followingScene(world_->scene, settings_.discretization);
}

UpdateCost DynamicSolution::update(std::span<const Edit> edits, const Progress& progress, const Snapshot* snapshot) {
  return updateTo(edited(world_->scene, removed_, edits), progress, snapshot);
}

UpdateCost DynamicSolution::updateTo(EditedScene edit, const Progress& progress, const Snapshot* snapshot) {
  Discretization shooting = carried(discretization(), edit, settings_.discretization);
  auto next = std::make_unique<DrawnScene>(std::move(edit.scene), std::move(shooting), layOut_, settings_.drawing,
                                           makeRenderer_);
  OutsideFlux outside = next->drawn.outsideFlux();
  Bands emitted = emittedFlux(next->scene, next->discretization);
  addTo(emitted, sumOf(outside));
  const double allowed = settings_.solver.residual * (bandSum(emitted) > 0 ? bandSum(emitted) : light().lastEmitted);
  LightUpdate update(*world_, *next, edit.origins, rows_, settings_.solver.rowCacheBytes);
  // Windows are parts of rows that are drawn with index maps.
  const bool hasWindows = !settings_.rows && settings_.drawing.elementsBy == ElementsBy::Texture;
  const bool startsOver = light().stale > maxStale * allowed || (!update.isSameGeometry() && !hasWindows);
  if (startsOver && hasWindows) update.keepRows();
  if (!startsOver) update.update(light(), std::move(outside), shareLeftStale * (allowed - light().stale));
  UpdateCost cost = update.cost();
  cost.startedOver = startsOver;

  removed_ = std::move(edit.removed);
  rows_ = std::move(update.rows());
  ShotLight shot = startsOver ? nothingShot(next->discretization.patches, bandCount(next->scene), std::move(outside))
                              : std::move(update.light());
  world_ = std::move(next);
  PatchRows rows{.rowOf = [this](const Patch& patch) { return rowByViews(world_->drawn, rows_.ofViews, patch); },
                 .split = world_->drawn.splits()};
  if (settings_.rows) rows = settings_.rows(std::move(rows), scene(), discretization());
  solution_ = refine({.scene = scene(),
                      .discretization = discretization(),
                      .patches = std::move(world_->discretization.patches),
                      .rowOf = rows.rowOf,
                      .split = rows.split,
                      .prepare = rows.prepare,
                      .settings = settings_.solver,
                      .snapshot = snapshot,
                      .isContinued = true},
                     {std::move(shot), {std::move(rows_.ofPatches), RowCache(0)}}, progress);
  rows_.ofPatches = std::move(solution_.continuation->rows.ofPatches);
  world_->discretization.patches = std::move(solution_.patches);
  return cost;
}

}  // namespace hemitex::radiosity
