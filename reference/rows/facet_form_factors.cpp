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

/// The estimated error, per root of the least variance.
constexpr double errorPerLeast = 3;

/// The relative error of the closed form (quick_form_factor.h).
constexpr double closedFormError = 1e-4;

/// In scenes of more facets, most of which are not in front of each other, proofs for whole rows would take longer than
/// drawing.
constexpr std::size_t mostProven = 2048;

/// Points of each triangle: 2, 3 or 4 times a power of 4.
constexpr std::uint32_t fewestPoints = 8, mostPoints = 512;

/// With so many points of a triangle the estimated error tells what more points may reach: at best it falls as their
/// number grows.
constexpr std::uint32_t pointsThatTell = 32;

int resolutionFor(double maxError) { return maxError >= 0.005 ? 48 : 96; }

/// The light through pixels of a facet.
struct FacetLight {
  std::vector<double> seen, covered;  ///< of each view; views behind the end of `seen` do not see the facet
  double unblocked = -1;              ///< the closed form, once it is known
  bool isFree = false;                ///< nothing lies between: the closed form is the form factor
};

double sumOf(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double square(double x) { return x * x; }

/// The points of a triangle that are together in one part of it, of all points: 2, 3 or 4 (pointOfTriangle).
std::size_t pointsTogether(std::size_t points) { return points > 4 ? pointsTogether(points / 4) : points; }

/// The variance of the sum of values over the points of triangles: point p of triangle t has the place p triangles + t.
/// `together` of the points of each triangle are in one part of it. They are random there, so that their differences
/// tell the error of the part.
double varianceOf(const std::vector<double>& values, std::size_t together) {
  const std::size_t stride = values.size() / together;
  double squares = 0;
  for (std::size_t first = 0; first < stride; ++first) {
    double mean = 0;
    for (std::size_t k = first; k < values.size(); k += stride) mean += values[k];
    mean /= static_cast<double>(together);
    for (std::size_t k = first; k < values.size(); k += stride) squares += square(values[k] - mean);
  }
  return squares * static_cast<double>(together) / static_cast<double>(together - 1);
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
/// not. If all points see all of it, the next one may not. The differences of points tell more, but may be small by
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

/// A view, and the area of its triangle.
struct WeightedView {
  radiosity::View view;
  double weight;
};

/// Variances of a sum over points: by points in one part of a triangle, and by all points of a triangle.
struct Spread {
  double inParts = 0, overall = 0;
};

/// A share of a row while it is estimated.
struct Share {
  std::uint32_t column = 0;
  double value = 0, most = 1;  ///< that it may have
  double error = 0;            ///< by the differences of points
  double least = 0;            ///< error
  double unseen = 0;           ///< light that no point sees arrive, of which it may have all
  double variance = 0;         ///< by the differences of points in one part of the facet

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
        lights_(images.elements.size()),
        poleShare_(poleShare(resolutionFor(settings.maxError))) {}

  SparseRow row(std::uint32_t facet) {
    const auto facets = static_cast<std::uint32_t>(scene_.surfaces.size());
    const auto images = static_cast<std::uint32_t>(lights_.size());
    if (const std::optional<SparseRow> proven = provenRow(facet)) return folded(*proven, facets, images);
    views_.clear();
    background_.clear();
    backs_.clear();
    weight_ = 0;
    triangles_ = scene_.surfaces[facet].triangles.size();
    SparseRow row;
    for (std::uint32_t points = 0, count = triangles_ > 1 ? fewestPoints / 2 : fewestPoints;;) {
      for (; points < count; ++points) addViews(facet, points);
      lookAtSeen(facet);
      row = rowOf(facet);
      const bool isOutOfReach = points >= pointsThatTell && *row.rowError * points > settings_.maxError * mostPoints;
      if (*row.rowError <= settings_.maxError || isOutOfReach || count == mostPoints) break;
      const auto together = static_cast<std::uint32_t>(pointsTogether(count));
      count += count / together * (together == 4 ? 4 : 1);
    }
    for (const std::uint32_t f : touched_) lights_[f] = {};
    touched_.clear();
    return folded(row, facets, images);
  }

 private:
  /// The row of a facet that sees all of each facet in front of it, and no back; else nothing.
  std::optional<SparseRow> provenRow(std::uint32_t facet) const {
    if (lights_.size() > mostProven) return std::nullopt;
    std::vector<Share> shares;
    double sum = 0;
    for (std::uint32_t number = 0; number < lights_.size(); ++number) {
      if (shafts_.maySeeBack(facet, number)) return std::nullopt;
      const double unblocked = quickFormFactor(shafts_.polygonsOf(facet), shafts_.polygonsOf(number));
      if (unblocked == 0) continue;
      if (!shafts_.isFree(facet, number)) return std::nullopt;
      shares.push_back({.column = number, .value = unblocked, .most = unblocked});
      shares.back().error = closedFormError * unblocked;
      sum += unblocked;
    }
    const auto outside = static_cast<std::uint32_t>(lights_.size());
    shares.push_back({.column = outside, .value = std::max(1 - sum, 0.0)});
    shares.back().error = closedFormError * sum;
    shares.push_back({.column = outside + 1});
    return rowOf(shares, closedFormError * sum);
  }

  /// Adds the next point of each triangle.
  void addViews(std::uint32_t facet, std::uint32_t point) {
    const radiosity::Surface& surface = scene_.surfaces[facet];
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      const glm::dvec2 weights = pointOfTriangle((std::uint64_t{facet} << 24) + t, point);
      addView(facet, radiosity::pointOn(surface, t, weights), radiosity::area(surface.triangles[t]));
    }
  }

  /// `weight` is the area of the point's triangle.
  void addView(std::uint32_t facet, const radiosity::SurfacePoint& point, double weight) {
    const auto number = static_cast<int>(views_.size());
    const glm::dvec3 up = radiosity::upOf(radiosity::Orientation::Turned, point.normal, facet, number);
    views_.push_back({rows_.viewFrom({.surface = facet, .point = point, .up = up, .area = 1}), weight});
    const radiosity::FormFactorRow row = rows_.ofView(views_.back().view);
    for (std::size_t i = 0; i < row.elements.size(); ++i) {
      std::vector<double>& seen = lights_[row.elements[i]].seen;
      if (seen.empty()) touched_.push_back(row.elements[i]);
      seen.resize(views_.size());
      seen.back() = weight * formFactor(row.shares[i]);
    }
    background_.push_back(weight * formFactor(row.background));
    backs_.push_back(weight * formFactor(row.back));
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
    std::vector<double>& covered = lights_[number].covered;
    while (covered.size() < views_.size()) {
      const auto& [view, weight] = views_[covered.size()];
      double share = 0;
      for (const radiosity::Triangle& triangle : facet.triangles) {
        std::array<glm::dvec3, 3> corners = triangle.position;
        for (glm::dvec3& corner : corners) corner -= scene_.origin;
        share += radiosity::coveredShare(*view.projection, view.faces, corners);
      }
      covered.push_back(weight * share);
    }
  }

  void lookAtSeen(std::uint32_t facet) {
    std::sort(touched_.begin(), touched_.end());
    for (const std::uint32_t number : touched_) {
      FacetLight& light = lights_[number];
      light.seen.resize(views_.size());
      if (light.unblocked < 0) {
        light.unblocked = quickFormFactor(shafts_.polygonsOf(facet), shafts_.polygonsOf(number));
        light.isFree = shafts_.isFree(facet, number);
      }
      if (!light.isFree) countCovered(number);
    }
  }

  /// The share of a facet. `differences` becomes what each view tells of it, less the mean.
  Share shareOfFacet(std::uint32_t number, std::vector<double>& differences) const {
    const FacetLight& light = lights_[number];
    Share share{.column = number, .value = light.unblocked, .most = light.unblocked};
    share.error = closedFormError * light.unblocked;
    differences.assign(views_.size(), 0);
    if (light.isFree) return share;
    const double seen = sumOf(light.seen), covered = sumOf(light.covered), count = static_cast<double>(views_.size());
    const double pixels = covered / weight_ / poleShare_ * count;
    double part = 0, scale = 1 / weight_;
    if (pixels <= fewestPixels) {
      share.value = std::min(seen / weight_, share.most);
      share.least = std::sqrt(seen / weight_ * poleShare_ / count);
    } else {
      const double hidden = std::max(covered - seen, 0.0);
      part = visiblePart(seen, covered);
      scale = light.unblocked / covered;
      if (hidden <= hiddenAtMost * covered && hidden <= hiddenPixelsAtMost * poleShare_ * weight_) {
        share.error = std::max(share.error, scale * hidden);
        scale = 0;
      } else {
        share.value *= part;
      }
      share.least = light.unblocked * leastError(part, count, pixels);
    }
    for (std::size_t v = 0; v < differences.size(); ++v)
      differences[v] = scale * (light.seen[v] - (part > 0 ? part * light.covered[v] : 0));
    share.least = std::min(share.least, std::max(share.value, share.most - share.value));
    return share;
  }

  Share shareOutside(std::size_t column, const std::vector<double>& light) const {
    const double value = sumOf(light) / weight_, count = static_cast<double>(views_.size());
    return {.column = static_cast<std::uint32_t>(column),
            .value = value,
            .least = std::sqrt((value + poleShare_ / count) * poleShare_ / count) +
                     0.06 * std::sqrt(value * std::max(1 - value, 0.0) / (count * std::sqrt(count)))};
  }

  /// The variance of a sum of values times a factor.
  Spread spreadOf(const std::vector<double>& values, double scale) const {
    const std::size_t points = values.size() / triangles_;
    return {square(scale) * varianceOf(values, pointsTogether(points)), square(scale) * varianceOf(values, points)};
  }

  /// The estimated error, per root of the variance by points in one part. The differences of these points come from
  /// differences within quarters of the part, and of quarters. What quarters have to parts is about what parts have to
  /// the whole. Each point is in another quarter, so that m of 4 quarters add (4 - m) / 3 of their variance to the
  /// mean, but 4 / 3 of it to the differences. Few points know the variance roughly (Student's t).
  double errorPerDeviation(const Spread& spread) const {
    const auto together = static_cast<double>(pointsTogether(views_.size() / triangles_));
    const double within = spread.overall > 0 ? std::min(spread.inParts / spread.overall, 1.0) : 1, between = 1 - within;
    const double remains = (within + between * (4 - together) / 3) / (within + between * 4 / 3);
    const double known = static_cast<double>(views_.size()) * (1 - 1 / together);
    return std::sqrt(remains) * (2.5 + 8 / known);
  }

  /// The shares of facets that no point sees but some may see, if the others leave light for them.
  void addUnseen(std::uint32_t facet, double left, std::vector<Share>& shares) const {
    const std::size_t seen = shares.size();
    double sum = 0;
    for (std::uint32_t number = 0; number < lights_.size(); ++number) {
      if (!lights_[number].seen.empty()) continue;
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
    Spread all;
    std::vector<double> differences, sums(views_.size());
    const auto add = [&](Share share, const std::vector<double>& values, double scale) {
      const Spread own = spreadOf(values, scale);
      share.variance = own.inParts;
      all.inParts += own.inParts;
      all.overall += own.overall;
      shares.push_back(share);
    };
    for (const std::uint32_t number : touched_) {
      const Share share = shareOfFacet(number, differences);
      add(share, differences, 1);
      for (std::size_t v = 0; v < sums.size(); ++v) sums[v] += differences[v];
    }
    add(shareOutside(lights_.size(), background_), background_, 1 / weight_);
    add(shareOutside(lights_.size() + 1, backs_), backs_, 1 / weight_);
    const double perDeviation = errorPerDeviation(all);
    double sum = 0, variance = 0;
    for (Share& share : shares) {
      share.error = std::max(share.error, perDeviation * std::sqrt(share.variance));
      sum += share.value;
      variance += square(share.deviation());
    }
    const double together = perDeviation * std::sqrt(spreadOf(sums, 1).inParts);
    if (1 - sum > std::max(0.05 * settings_.maxError, 2 * std::sqrt(variance))) addUnseen(facet, 1 - sum, shares);
    std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.column < b.column; });
    return rowOf(shares, together);
  }

  /// `together` is the error of the sum of the shares of facets.
  SparseRow rowOf(std::vector<Share>& shares, double together) const {
    close(shares, together);
    SparseRow row;
    double errors = 0, squares = 0, unseen = 0;
    for (const Share& share : shares) {
      errors += share.error;
      unseen = std::max(unseen, share.unseen);
      squares += share.error * share.error + square(errorPerLeast * share.least);
      if (share.value <= 0 && share.column < lights_.size()) continue;
      row.column.push_back(share.column);
      row.value.push_back(share.value);
      row.error.push_back(
          asStored(std::max({share.error, errorPerLeast * share.least, std::min(share.most, share.unseen)})));
    }
    // Points seldom see how little light is divided that facets leave of which all is known.
    double left = 1;
    for (const std::uint32_t number : touched_)
      if (lights_[number].isFree) left -= lights_[number].unblocked;
    const double little = left <= settings_.maxError ? 1.5 * std::max(left, 0.0) : 0;
    // Of many errors few are as large as their estimates.
    row.rowError = std::max(errors / 2 + 2.0 / 3 * std::sqrt(squares) + 2 * unseen, little);
    return row;
  }

  /// Changes the shares so that all sum to 1: each in proportion to the square of its error, between 0 and the most
  /// that it may be. What is left then goes outside, or all change by one factor. No error is below the change. The sum
  /// tells surroundings and backs better than pixels where other errors are small.
  static void close(std::vector<Share>& shares, double together) {
    std::vector<double> before;
    for (const Share& share : shares) before.push_back(share.value);
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
    double squares = 0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      Share& share = shares[k];
      const double change = std::abs(share.value - before[k]);
      if (change > share.deviation()) share.error = change;
      if (k + 2 < shares.size()) squares += square(share.least);
    }
    const double least = std::sqrt(squares);
    Share &surroundings = shares[shares.size() - 2], &backs = shares.back();
    const Share outside = surroundings;
    surroundings.error = std::min(surroundings.error, together + backs.error);
    surroundings.least = std::min(surroundings.least, least + backs.least);
    backs.error = std::min(backs.error, together + outside.error);
    backs.least = std::min(backs.least, least + outside.least);
  }

  const radiosity::Scene& scene_;
  const FreeShafts& shafts_;
  FacetRowSettings settings_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  radiosity::ProjectedFormFactors rows_;
  std::vector<FacetLight> lights_;          ///< of each facet at each instance
  std::vector<std::uint32_t> touched_;      ///< those that the present row sees
  std::vector<WeightedView> views_;         ///< of the present row
  double weight_ = 0;                       ///< of the views
  std::size_t triangles_ = 0;               ///< of the facet
  std::vector<double> background_, backs_;  ///< the light of each view
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
  SparseRow row;
  workers_.with([&](std::unique_ptr<Worker>& worker) {
    if (!worker) worker = std::make_unique<Worker>(scene_, shafts_, images_, layout_, settings_);
    row = worker->row(facet);
  });
  return row;
}

}  // namespace hemitex::reference
