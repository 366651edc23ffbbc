#include "reference/rows/facet_form_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/covered_share.h"
#include "reference/matrices/sparse_matrix.h"
#include "reference/truth/closed_forms/quick_form_factor.h"

namespace hemitex::reference {
namespace {

using radiosity::formFactor;

/// A facet is visible as a whole if no more than this part of it is hidden, and no more than this number of pixels per
/// view: the covered pixels of this program and those of the renderer differ at edges.
constexpr double hiddenAtMost = 0.005, hiddenPixelsAtMost = 1;

/// A facet whose covered pixels have less light than this number of pixels at the pole has an uncertain visible part.
constexpr double fewestPixels = 4;

/// The estimated error, per standard error of the mean over the sets of points. Eight sets know the latter roughly.
constexpr double errorPerDeviation = 3;

/// The relative error of the closed form (quick_form_factor.h).
constexpr double closedFormError = 1e-4;

/// In scenes of more facets, most of which are not in front of each other, proofs for whole rows would take longer than
/// drawing.
constexpr std::size_t mostProven = 2048;

/// Of points, each alike but random, so that their differences tell the error.
constexpr std::size_t setCount = 8;
using PerSet = std::array<double, setCount>;

/// Points of each set and triangle, until the error is small enough.
constexpr std::array pointCounts{1, 2, 4, 8, 16, 32, 50};

int resolutionFor(double maxError) { return maxError >= 0.005 ? 64 : 128; }

/// The light through pixels of a facet, from the sets of points.
struct FacetSums {
  PerSet seen{}, covered{};
  int views = 0;          ///< that `covered` counts
  double unblocked = -1;  ///< the closed form, once it is known
  bool isFree = false;    ///< nothing lies between: the closed form is the form factor
};

double sumOf(const PerSet& sums) { return std::accumulate(sums.begin(), sums.end(), 0.0); }

double square(double x) { return x * x; }

/// The standard error of the sum of sets that are alike.
double deviationOf(const PerSet& sums) {
  const double mean = sumOf(sums) / setCount;
  double squares = 0;
  for (const double sum : sums) squares += (sum - mean) * (sum - mean);
  return std::sqrt(squares * setCount / (setCount - 1));
}

double visiblePart(double seen, double covered) { return covered > 0 ? std::min(seen / covered, 1.0) : 0; }

/// A number whose bits are those of a random one (Steele, Lea and Flood, Fast splittable pseudorandom number
/// generators, 2014).
std::uint64_t mixed(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9;
  number = (number ^ (number >> 27)) * 0x94d049bb133111eb;
  return number ^ (number >> 31);
}

/// Barycentric weights of the corners 1 and 2 of a point of a sequence: the digits of its number choose quarters of the
/// triangle, and quarters of these, so that 4^k points have one in each of its 4^k equal parts (Basu and Owen, Low
/// discrepancy constructions in the triangle, 2015). The random bits behind `seed` exchange the quarters, so that each
/// sequence is another one.
glm::dvec2 pointOfTriangle(std::uint64_t seed, std::uint32_t number) {
  glm::dvec2 point(1.0 / 3);  // the middle of what is left
  double side = 1;            // below 0: the part is turned over
  std::uint64_t bits = mixed(seed);
  for (int level = 0; level < 20; ++level, number /= 4) {
    const auto quarter = static_cast<int>((number ^ bits) % 4);
    bits = mixed(bits + number % 4);
    side /= 2;
    // The middle of each outer quarter is that of the whole plus half of the way from it to the corner.
    if (quarter == 1) point += side / 3 * glm::dvec2(-1, -1);
    if (quarter == 2) point += side / 3 * glm::dvec2(2, -1);
    if (quarter == 3) point += side / 3 * glm::dvec2(-1, 2);
    if (quarter == 0) side = -side;
  }
  return point;
}

/// The least error of the visible part of a facet that n points see through a number of pixels: the border of the
/// points that see it crosses about the root of n cells, each of which is off by up to 1 / n, and each pixel is seen or
/// not. If all points see all of it, the next one may not. The differences of the sets tell more, but may be small by
/// chance.
double leastError(double part, double n, double pixels) {
  const double uncertain = std::clamp(part, 1 / (n + 2), 1 - 1 / (n + 2));
  return 0.3 * std::sqrt(uncertain * (1 - uncertain) * (1 / (n * std::sqrt(n)) + 1 / pixels)) + 1 / pixels;
}

/// The share of the light through a pixel at the pole, which is the largest: the area of the pixel over pi.
double poleShare(int resolution) {
  const double side = 2.0 / resolution;
  return side * side * std::numbers::inv_pi;
}

/// Draws the facets at all instances, whose item IDs are their numbers.
raster::DrawList drawsOfFacets(const radiosity::Scene& scene, const radiosity::IdLayout& layout) {
  raster::DrawList list;
  list.format = layout.format;
  for (const radiosity::Instance& instance : scene.instances)
    for (const radiosity::Surface& facet : scene.surfaces) {
      const auto number = static_cast<raster::ItemId>(list.draws.size());
      raster::Draw& draw = appendDraw(list, facet.triangles, instance, scene.origin);
      draw.offset = number;
      draw.back = raster::backId(layout.format);
    }
  return list;
}

/// Adds up the columns of the images of each of n facets; two more columns are kept.
SparseRow folded(const SparseRow& row, std::uint32_t facets, std::uint32_t images) {
  std::map<std::uint32_t, std::pair<double, double>> sums;
  for (std::size_t k = 0; k < row.column.size(); ++k) {
    const std::uint32_t column = row.column[k];
    auto& [value, error] = sums[column < images ? column % facets : column - images + facets];
    value += row.value[k];
    error += row.error[k];
  }
  SparseRow result;
  result.rowError = row.rowError;
  for (const auto& [column, sum] : sums) {
    result.column.push_back(column);
    result.value.push_back(sum.first);
    result.error.push_back(sum.second);
  }
  return result;
}

/// The facets at all instances.
std::vector<ConvexPolygons> polygonsInSpace(const radiosity::Scene& scene) {
  const std::vector<ConvexPolygons> facets = convexPolygons(scene);
  std::vector<ConvexPolygons> images;
  for (const radiosity::Instance& instance : scene.instances)
    for (const ConvexPolygons& facet : facets) images.push_back(placed(scene, facet, instance));
  return images;
}

/// A view, the area of its triangle and the set of its point.
struct WeightedView {
  radiosity::View view;
  double weight;
  std::size_t set;
};

/// A share of a row while it is estimated.
struct Share {
  std::uint32_t column = 0;
  double value = 0, most = 1;  ///< that it may have
  double error = 0;            ///< by the differences of sets
  double least = 0;            ///< error
  double unseen = 0;           ///< light that no point sees arrive, of which it may have all

  double deviation() const { return std::max(error, least); }
};

}  // namespace

/// What one thread needs to compute rows.
class FacetFormFactors::Worker {
 public:
  Worker(const radiosity::Scene& scene, const FreeShafts& shafts, const radiosity::Discretization& images,
         const radiosity::IdLayout& layout, const FacetRowSettings& settings)
      : scene_(scene),
        shafts_(shafts),
        settings_(settings),
        renderer_(radiosity::softwareRenderer(drawsOfFacets(scene, layout))),
        rows_(scene, images, layout, *renderer_, {.resolution = resolutionFor(settings.maxError)}),
        sums_(images.elements.size()),
        poleShare_(poleShare(resolutionFor(settings.maxError))) {}

  SparseRow row(std::uint32_t facet) {
    const auto facets = static_cast<std::uint32_t>(scene_.surfaces.size());
    const auto images = static_cast<std::uint32_t>(sums_.size());
    if (const std::optional<SparseRow> proven = provenRow(facet)) return folded(*proven, facets, images);
    views_.clear();
    background_ = backs_ = {};
    weight_ = 0;
    int points = 0;
    SparseRow row;
    for (const int count : pointCounts) {
      for (; points < count; ++points) addViews(facet, points);
      lookAtSeen(facet);
      row = rowOf(facet);
      if (*row.rowError <= settings_.maxError) break;
    }
    for (const std::uint32_t f : touched_) sums_[f] = {};
    touched_.clear();
    return folded(row, facets, images);
  }

 private:
  /// The row of a facet that sees all of each facet in front of it, and no back; else nothing.
  std::optional<SparseRow> provenRow(std::uint32_t facet) const {
    if (sums_.size() > mostProven) return std::nullopt;
    std::vector<Share> shares;
    double sum = 0;
    for (std::uint32_t number = 0; number < sums_.size(); ++number) {
      if (shafts_.maySeeBack(facet, number)) return std::nullopt;
      const double unblocked = quickFormFactor(shafts_.polygonsOf(facet), shafts_.polygonsOf(number));
      if (unblocked == 0) continue;
      if (!shafts_.isFree(facet, number)) return std::nullopt;
      shares.push_back({.column = number, .value = unblocked, .most = unblocked});
      shares.back().error = closedFormError * unblocked;
      sum += unblocked;
    }
    const auto outside = static_cast<std::uint32_t>(sums_.size());
    shares.push_back({.column = outside, .value = std::max(1 - sum, 0.0)});
    shares.back().error = closedFormError * sum;
    shares.push_back({.column = outside + 1});
    return rowOf(shares);
  }

  /// Adds the next point of each set and triangle.
  void addViews(std::uint32_t facet, int point) {
    const radiosity::Surface& surface = scene_.surfaces[facet];
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
      for (std::size_t set = 0; set < setCount; ++set) {
        const std::uint64_t seed = (std::uint64_t{facet} << 24) + t * setCount + set;
        const glm::dvec2 weights = pointOfTriangle(seed, static_cast<std::uint32_t>(point));
        addView(facet, radiosity::pointOn(surface, t, weights), radiosity::area(surface.triangles[t]), set);
      }
  }

  /// `weight` is the area of the point's triangle.
  void addView(std::uint32_t facet, const radiosity::SurfacePoint& point, double weight, std::size_t set) {
    const auto number = static_cast<int>(views_.size());
    const glm::dvec3 up = radiosity::upOf(radiosity::Orientation::Turned, point.normal, facet, number);
    views_.push_back({rows_.viewFrom({.surface = facet, .point = point, .up = up, .area = 1}), weight, set});
    const radiosity::FormFactorRow row = rows_.ofView(views_.back().view);
    for (std::size_t i = 0; i < row.elements.size(); ++i) {
      const std::uint32_t seen = row.elements[i];
      if (sumOf(sums_[seen].seen) == 0) touched_.push_back(seen);
      sums_[seen].seen[set] += weight * formFactor(row.shares[i]);
    }
    background_[set] += weight * formFactor(row.background);
    backs_[set] += weight * formFactor(row.back);
    weight_ += weight;
  }

  /// A facet at an instance.
  radiosity::Surface imageOf(std::uint32_t number) const {
    const std::size_t facets = scene_.surfaces.size();
    return radiosity::placed(scene_.surfaces[number % facets], scene_.instances[number / facets]);
  }

  /// Adds what each seen facet covers in the views in which it was not counted yet, also where it is hidden.
  void countCovered(std::uint32_t number) {
    const radiosity::Surface facet = imageOf(number);
    FacetSums& sums = sums_[number];
    for (; sums.views < static_cast<int>(views_.size()); ++sums.views) {
      const auto& [view, weight, set] = views_[static_cast<std::size_t>(sums.views)];
      for (const radiosity::Triangle& triangle : facet.triangles) {
        std::array<glm::dvec3, 3> corners = triangle.position;
        for (glm::dvec3& corner : corners) corner -= scene_.origin;
        sums.covered[set] += weight * radiosity::coveredShare(*view.projection, view.faces, corners);
      }
    }
  }

  void lookAtSeen(std::uint32_t facet) {
    std::sort(touched_.begin(), touched_.end());
    for (const std::uint32_t number : touched_) {
      FacetSums& sums = sums_[number];
      if (sums.unblocked < 0) {
        sums.unblocked = quickFormFactor(shafts_.polygonsOf(facet), shafts_.polygonsOf(number));
        sums.isFree = shafts_.isFree(facet, number);
      }
      if (!sums.isFree) countCovered(number);
    }
  }

  Share shareOfFacet(std::uint32_t number) const {
    const FacetSums& sums = sums_[number];
    Share share{.column = number, .value = sums.unblocked, .most = sums.unblocked};
    share.error = closedFormError * sums.unblocked;
    if (sums.isFree) return share;
    const double seen = sumOf(sums.seen), covered = sumOf(sums.covered), count = static_cast<double>(views_.size());
    const double pixels = covered / weight_ / poleShare_ * count;
    if (pixels <= fewestPixels) {
      share.value = std::min(seen / weight_, share.most);
      share.error = errorPerDeviation * deviationOf(sums.seen) / weight_;
      share.least = std::sqrt(seen / weight_ * poleShare_ / count);
    } else {
      const double part = visiblePart(seen, covered), hidden = std::max(covered - seen, 0.0);
      const bool isWhole = hidden <= hiddenAtMost * covered && hidden <= hiddenPixelsAtMost * poleShare_ * weight_;
      PerSet differences{};
      for (std::size_t set = 0; set < setCount; ++set) differences[set] = sums.seen[set] - part * sums.covered[set];
      const double error = isWhole ? hidden / covered : errorPerDeviation * deviationOf(differences) / covered;
      if (!isWhole) share.value *= part;
      share.error = std::max(share.error, sums.unblocked * error);
      share.least = sums.unblocked * leastError(part, count, pixels);
    }
    share.least = std::min(share.least, std::max(share.value, share.most - share.value));
    return share;
  }

  Share shareOutside(std::size_t column, const PerSet& sums) const {
    const double value = sumOf(sums) / weight_, count = static_cast<double>(views_.size());
    return {.column = static_cast<std::uint32_t>(column),
            .value = value,
            .error = errorPerDeviation * deviationOf(sums) / weight_,
            .least = std::sqrt((value + poleShare_ / count) * poleShare_ / count) +
                     0.06 * std::sqrt(value * std::max(1 - value, 0.0) / (count * std::sqrt(count)))};
  }

  /// The shares of facets that no point sees but some may see, if the others leave light for them.
  void addUnseen(std::uint32_t facet, double left, std::vector<Share>& shares) const {
    const std::size_t seen = shares.size();
    double sum = 0;
    for (std::uint32_t number = 0; number < sums_.size(); ++number) {
      if (sumOf(sums_[number].seen) > 0) continue;
      const double unblocked = quickFormFactor(shafts_.polygonsOf(facet), shafts_.polygonsOf(number));
      if (unblocked == 0) continue;
      const bool isFree = shafts_.isFree(facet, number);
      shares.push_back({.column = number, .value = isFree ? unblocked : 0, .most = unblocked});
      shares.back().error = isFree ? closedFormError * unblocked : 0;
      if (!isFree) sum += unblocked;
    }
    for (auto share = shares.begin() + static_cast<std::ptrdiff_t>(seen); share != shares.end(); ++share)
      if (share->value == 0) {
        share->error = std::min(share->most, left * share->most / sum);
        share->unseen = left;
      }
  }

  SparseRow rowOf(std::uint32_t facet) const {
    std::vector<Share> shares;
    double sum = 0, variance = 0;
    const auto add = [&](const Share& share) {
      shares.push_back(share);
      sum += share.value;
      variance += share.deviation() * share.deviation();
    };
    for (const std::uint32_t number : touched_) add(shareOfFacet(number));
    add(shareOutside(sums_.size(), background_));
    add(shareOutside(sums_.size() + 1, backs_));
    if (1 - sum > std::max(0.05 * settings_.maxError, 2 * std::sqrt(variance))) addUnseen(facet, 1 - sum, shares);
    std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.column < b.column; });
    return rowOf(shares);
  }

  SparseRow rowOf(std::vector<Share>& shares) const {
    close(shares);
    SparseRow row;
    double errors = 0, squares = 0, unseen = 0;
    for (const Share& share : shares) {
      errors += share.error;
      unseen = std::max(unseen, share.unseen);
      squares += share.error * share.error + square(errorPerDeviation * share.least);
      if (share.value <= 0 && share.column < sums_.size()) continue;
      row.column.push_back(share.column);
      row.value.push_back(share.value);
      row.error.push_back(
          asStored(std::max({share.error, errorPerDeviation * share.least, std::min(share.most, share.unseen)})));
    }
    // Points seldom see how little light is divided that facets leave of which all is known.
    double left = 1;
    for (const std::uint32_t number : touched_)
      if (sums_[number].isFree) left -= sums_[number].unblocked;
    const double little = left <= settings_.maxError ? 1.5 * std::max(left, 0.0) : 0;
    // Of many errors few are as large as their estimates.
    row.rowError = std::max(errors / 2 + std::sqrt(squares) + 2 * unseen, little);
    return row;
  }

  /// Changes the shares so that all sum to 1: each in proportion to the square of its error, between 0 and the most
  /// that it may be. What is left then goes outside, or all change by one factor. No error is below the change. The sum
  /// tells surroundings and backs better than pixels where other errors are small.
  static void close(std::vector<Share>& shares) {
    std::vector<double> before;
    double deviations = 0;
    for (const Share& share : shares) {
      before.push_back(share.value);
      deviations += share.deviation();
    }
    for (int round = 0; round < 20; ++round) {
      double missing = 1, free = 0;
      const auto canMove = [&](const Share& share) { return missing > 0 ? share.value < share.most : share.value > 0; };
      for (const Share& share : shares) missing -= share.value;
      for (const Share& share : shares)
        if (canMove(share)) free += share.deviation() * share.deviation();
      if (std::abs(missing) < 1e-15 || free == 0) break;
      for (Share& share : shares)
        if (canMove(share))
          share.value =
              std::clamp(share.value + missing / free * share.deviation() * share.deviation(), 0.0, share.most);
    }
    double sum = 0;
    for (const Share& share : shares) sum += share.value;
    if (sum < 1)
      shares[shares.size() - 2].value += 1 - sum;
    else
      for (Share& share : shares) share.value /= sum;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      Share& share = shares[k];
      const double own = share.deviation(), others = deviations - own, change = std::abs(share.value - before[k]);
      if (change > own) share.error = change;
      if (change > own || own == 0 || k + 2 < shares.size()) continue;
      const double smaller = others / std::sqrt(square(others) + square(own));
      share.error *= smaller;
      share.least *= smaller;
    }
  }

  const radiosity::Scene& scene_;
  const FreeShafts& shafts_;
  FacetRowSettings settings_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  radiosity::ProjectedFormFactors rows_;
  std::vector<FacetSums> sums_;         ///< of each facet at each instance
  std::vector<std::uint32_t> touched_;  ///< those that the present row sees
  std::vector<WeightedView> views_;     ///< of the present row
  double weight_ = 0;                   ///< of the views
  PerSet background_{}, backs_{};
  double poleShare_;
};

FacetFormFactors::FacetFormFactors(const radiosity::Scene& scene, const FacetRowSettings& settings)
    : scene_(scene), settings_(settings), shafts_(polygonsInSpace(scene)) {
  images_.elements.resize(scene.instances.size() * scene.surfaces.size());
  layout_.format = *raster::formatNamed("r32ui");
  layout_.indexMaps = radiosity::IndexMaps::Unique;
}

FacetFormFactors::~FacetFormFactors() = default;

SparseRow FacetFormFactors::row(std::uint32_t facet) {
  std::unique_ptr<Worker> worker;
  {
    const std::lock_guard guard(mutex_);
    if (!idle_.empty()) {
      worker = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  if (!worker) worker = std::make_unique<Worker>(scene_, shafts_, images_, layout_, settings_);
  SparseRow row = worker->row(facet);
  const std::lock_guard guard(mutex_);
  idle_.push_back(std::move(worker));
  return row;
}

}  // namespace hemitex::reference
