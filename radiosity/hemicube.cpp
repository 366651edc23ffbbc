#include "radiosity/hemicube.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "radiosity/patch_points.h"

namespace hemitex::radiosity {
namespace {

/// Gauss-Legendre nodes and weights of four points on [0, 1].
struct GaussRule {
  std::array<double, 4> node, weight;
};

GaussRule gaussRule() {
  const double root = std::sqrt(6.0 / 5.0);
  const double inner = std::sqrt((3 - 2 * root) / 7), outer = std::sqrt((3 + 2 * root) / 7);
  const double innerWeight = (18 + std::sqrt(30.0)) / 72, outerWeight = (18 - std::sqrt(30.0)) / 72;
  return {{(1 - outer) / 2, (1 - inner) / 2, (1 + inner) / 2, (1 + outer) / 2},
          {outerWeight, innerWeight, innerWeight, outerWeight}};
}

constexpr double pi = 3.14159265358979323846;

// cos(theta) / pi per area of the cube (Cohen and Greenberg 1985). With s the distance to the cube's point, cos(theta)
// is 1/s on the top face and z/s on a side, the foreshortening is 1/s, and solid angle falls with 1/s^2.
double topDensity(double x, double y) {
  const double s2 = x * x + y * y + 1;
  return 1 / (pi * s2 * s2);
}
double sideDensity(double x, double z) {
  const double s2 = x * x + z * z + 1;
  return z / (pi * s2 * s2);
}

/// Integrals of a density over the (resolution / 2)^2 pixels of the square [0, 1]^2, row-major, in units of 2^-60.
/// A pixel wider than 1/16 is cut into parts, so that four by four points always reach rounding accuracy.
template <typename Density>
std::vector<std::uint64_t> pixelIntegrals(int resolution, const Density& density) {
  static const GaussRule rule = gaussRule();
  const int side = resolution / 2;
  const int parts = (16 + side - 1) / side;
  const double width = 1.0 / (side * parts);
  std::vector<std::uint64_t> integrals;
  integrals.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      double sum = 0;
      for (int part = 0; part < parts * parts; ++part)
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j) {
            const double x = (column * parts + part % parts + rule.node[i]) * width;
            const double y = (row * parts + part / parts + rule.node[j]) * width;
            sum += rule.weight[i] * rule.weight[j] * density(x, y);
          }
      integrals.push_back(static_cast<std::uint64_t>(std::nearbyint(std::ldexp(sum * width * width, shareBits))));
    }
  return integrals;
}

/// Spreads what rounding left over, so that four quadrants of the top and eight halves of sides are a whole: the same
/// amount for every pixel of the quadrant, and one unit more for the first of them.
void closeSum(std::vector<std::uint64_t>& top, const std::vector<std::uint64_t>& side) {
  const std::uint64_t sum = std::accumulate(top.begin(), top.end(), std::uint64_t{0}) +
                            2 * std::accumulate(side.begin(), side.end(), std::uint64_t{0});
  const auto missing = static_cast<std::int64_t>(wholeShare / 4 - sum);
  const auto count = static_cast<std::int64_t>(top.size());
  const std::int64_t remainder = (missing % count + count) % count;
  const std::int64_t each = (missing - remainder) / count;
  for (std::int64_t i = 0; i < count; ++i)
    top[static_cast<std::size_t>(i)] += static_cast<std::uint64_t>(each + (i < remainder ? 1 : 0));
}

/// A unit vector at right angles to the unit vector `normal`, along `up` as far as that is possible.
glm::dvec3 tangentAlong(const glm::dvec3& normal, const glm::dvec3& up) {
  const glm::dvec3 tangent = up - glm::dot(up, normal) * normal;
  const double length = glm::length(tangent);
  if (length > 1e-6 * glm::length(up)) return tangent / length;
  const glm::dvec3 a = glm::abs(normal);
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                   : glm::dvec3(0, 0, 1);
  return tangentAlong(normal, axis);
}

/// The direction at right angles to a normal that lies a share of a quarter turn from the first axis there: of a
/// circle's rational points, which need no sine that would differ between machines. Not quite even, which does not
/// matter.
glm::dvec3 quarterTurn(const glm::dvec3& normal, double share) {
  const glm::dvec3 x = tangentAlong(normal, glm::dvec3(0)), y = glm::cross(normal, x);
  return (1 - share * share) * x + 2 * share * y;
}

/// The squared distance from a point to a triangle: to the plane where the point projects inside, else to an edge.
double squaredDistance(const glm::dvec3& point, const std::array<glm::dvec3, 3>& corner) {
  const glm::dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3& a = corner[k];
    const glm::dvec3 edge = corner[(k + 1) % 3] - a;
    inside &= glm::dot(glm::cross(n, edge), point - a) >= 0;
    const double t = std::clamp(glm::dot(point - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    const glm::dvec3 offset = point - (a + t * edge);
    nearest = std::min(nearest, glm::dot(offset, offset));
  }
  const double height = glm::dot(n, point - corner[0]);
  return inside ? height * height / glm::dot(n, n) : nearest;
}

/// The squared distance from a point to the box around a triangle: a lower bound that is cheap.
double squaredDistanceToBounds(const glm::dvec3& point, const std::array<glm::dvec3, 3>& corner) {
  const glm::dvec3 low = glm::min(glm::min(corner[0], corner[1]), corner[2]);
  const glm::dvec3 high = glm::max(glm::max(corner[0], corner[1]), corner[2]);
  const glm::dvec3 offset = point - glm::clamp(point, low, high);
  return glm::dot(offset, offset);
}

bool liesInPlane(const Triangle& triangle, const SurfacePoint& point, double tolerance) {
  return std::all_of(triangle.position.begin(), triangle.position.end(), [&](const glm::dvec3& corner) {
    return std::abs(glm::dot(corner - point.position, point.normal)) <= tolerance;
  });
}

bool facesAway(const Triangle& triangle, const glm::dvec3& eye) {
  const glm::dvec3 n =
      glm::cross(triangle.position[1] - triangle.position[0], triangle.position[2] - triangle.position[0]);
  return glm::dot(eye - triangle.position[0], n) < 0;
}

}  // namespace

DeltaFormFactors::DeltaFormFactors(int resolution)
    : resolution_(resolution),
      top_(pixelIntegrals(resolution, topDensity)),
      side_(pixelIntegrals(resolution, sideDensity)) {
  assert(resolution >= 2 && resolution <= 4096 && resolution % 2 == 0);
  closeSum(top_, side_);
}

std::uint64_t DeltaFormFactors::top(int column, int row) const {
  const int half = resolution_ / 2;
  const auto fromCentre = [half](int i) { return static_cast<std::size_t>(i < half ? half - 1 - i : i - half); };
  return top_[fromCentre(row) * static_cast<std::size_t>(half) + fromCentre(column)];
}

std::uint64_t DeltaFormFactors::side(int column, int row) const {
  const int half = resolution_ / 2;
  const int fromCentre = column < half ? half - 1 - column : column - half;
  return side_[static_cast<std::size_t>(row) * static_cast<std::size_t>(half) + static_cast<std::size_t>(fromCentre)];
}

std::array<raster::Face, 5> hemicubeFaces(const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& up,
                                          double nearDistance, int resolution) {
  const glm::dvec3 y = tangentAlong(normal, up);
  const glm::dvec3 x = glm::cross(y, normal);
  const raster::Scissor whole{0, 0, resolution, resolution};
  const raster::Scissor aboveHorizon{0, resolution / 2, resolution, resolution / 2};
  const auto face = [&](const glm::dvec3& right, const glm::dvec3& rows, const glm::dvec3& forward,
                        const raster::Scissor& scissor) {
    return raster::Face{
        glm::vec3(position), glm::vec3(right), glm::vec3(rows), glm::vec3(forward), static_cast<float>(nearDistance),
        resolution,          scissor};
  };
  // The sides look right, along the rows, left and against the rows of the top face; every determinant is 1.
  return {face(x, y, normal, whole), face(y, normal, x, aboveHorizon), face(-x, normal, y, aboveHorizon),
          face(-y, normal, -x, aboveHorizon), face(x, normal, -y, aboveHorizon)};
}

std::vector<std::uint32_t> skippedTriangles(const Scene& scene, std::uint32_t surface, const SurfacePoint& point) {
  const double tolerance = tangentPlaneTolerance * scene.extent;
  std::vector<std::uint32_t> skipped;
  std::uint32_t number = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      const bool isOwn = s == surface || scene.surfaces[s].twin == static_cast<int>(surface);
      if ((isOwn && liesInPlane(triangle, point, tolerance)) ||
          (scene.surfaces[s].twin && facesAway(triangle, point.position)))
        skipped.push_back(number);
      ++number;
    }
  return skipped;
}

double nearDistance(const Scene& scene, const glm::dvec3& point, const std::vector<std::uint32_t>& skipped) {
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t number = 0;
  auto skip = skipped.begin();
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      if (skip != skipped.end() && *skip == number++) {
        ++skip;
        continue;
      }
      if (squaredDistanceToBounds(point, triangle.position) < nearest)
        nearest = std::min(nearest, squaredDistance(point, triangle.position));
    }
  return std::clamp(std::sqrt(nearest / 3), smallestNearDistance * scene.extent, scene.extent);
}

double turnOf(std::uint32_t patch, int point) {
  // The golden section and its square, in units of 2^-32; the product wraps around to the fraction.
  const std::uint32_t turn = patch * 0x9e3779b9U + static_cast<std::uint32_t>(point) * 0x61c88647U;
  return turn * 0x1p-32;
}

HemicubeRows::HemicubeRows(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                           raster::ItemBufferRenderer& renderer, int resolution, Orientation orientation)
    : scene_(scene),
      discretization_(discretization),
      layout_(layout),
      renderer_(renderer),
      resolution_(resolution),
      orientation_(orientation),
      share_(discretization.elements.size()) {}

const DeltaFormFactors& HemicubeRows::deltasAfter(int halvings) {
  const int halved = resolution_ >> halvings;
  const int resolution = std::min(resolution_, std::max(smallestResolution, halved + halved % 2));
  return deltas_.try_emplace(resolution, resolution).first->second;
}

glm::dvec3 HemicubeRows::eyeOver(std::uint32_t surface, const SurfacePoint& point) const {
  const std::array<glm::dvec3, 3>& corner = scene_.surfaces[surface].triangles[point.triangle].position;
  const glm::dvec3 inward = (corner[0] + corner[1] + corner[2]) / 3.0 - point.position;
  const double distance = glm::length(inward);
  const double share = distance > 0 ? std::min(0.5, eyeMove * scene_.extent / distance) : 0;
  return point.position + share * inward + eyeLift * scene_.extent * point.normal;
}

FormFactorRow HemicubeRows::draw(std::uint32_t surface, const SurfacePoint& point, const glm::dvec3& up, int halvings) {
  const DeltaFormFactors& deltas = deltasAfter(halvings);
  const std::vector<std::uint32_t> skipped = skippedTriangles(scene_, surface, point);
  const glm::dvec3 eye = eyeOver(surface, point);
  const std::array<raster::Face, 5> faces =
      hemicubeFaces(eye - scene_.origin, point.normal, up, nearDistance(scene_, eye, skipped), deltas.resolution());
  return count(renderer_.render(faces, skipped), deltas);
}

FormFactorRow HemicubeRows::from(std::uint32_t surface, const SurfacePoint& point) {
  return draw(surface, point, glm::dvec3(0), 0);
}

FormFactorRow HemicubeRows::ofPatch(std::uint32_t number) {
  const Patch& patch = discretization_.patches[number];
  const auto rowFrom = [&](const SurfacePoint& point, int index, int halvings) {
    const glm::dvec3 up =
        orientation_ == Orientation::Aligned ? glm::dvec3(0) : quarterTurn(point.normal, turnOf(number, index));
    return draw(patch.surface, point, up, halvings);
  };
  const std::vector<ShootingBlock> blocks =
      patch.points == 1 ? std::vector<ShootingBlock>() : shootingBlocks(scene_, discretization_, patch);
  // A texel with next to no area may have none left in any block, to within rounding.
  if (blocks.empty()) return rowFrom(patchCentre(scene_, discretization_, patch), 0, patch.halvings);
  std::vector<WeightedRow> rows;
  int index = 0;
  for (const ShootingBlock& block : blocks)
    rows.push_back({rowFrom(block.centre, index++, patch.halvings), block.area});
  return meanOf(rows);
}

FormFactorRow HemicubeRows::count(const std::vector<raster::ItemBuffer>& faces, const DeltaFormFactors& deltas) {
  FormFactorRow row;
  const auto add = [&](raster::Word word, std::uint64_t share) {
    if (word == raster::backWord(layout_.format)) {
      row.back += share;
    } else if (const auto seen = texelOf(discretization_, layout_, word)) {
      const std::uint32_t element = discretization_.grids[seen->surface].spill[seen->texel];
      if (share_[element] == 0) row.elements.push_back(element);
      share_[element] += share;
    } else {
      row.background += share;
    }
  };
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const raster::ItemBuffer& buffer = faces[face];
    // Neighbouring pixels mostly show the same element: their shares are added before the word is looked up.
    raster::Word run = buffer.words.front();
    std::uint64_t share = 0;
    const raster::Word* word = buffer.words.data();
    for (int j = 0; j < buffer.height; ++j)
      for (int i = 0; i < buffer.width; ++i, ++word) {
        if (*word != run) {
          add(run, share);
          run = *word;
          share = 0;
        }
        share += face == 0 ? deltas.top(i, j) : deltas.side(i, j);
      }
    add(run, share);
  }
  std::sort(row.elements.begin(), row.elements.end());
  for (const std::uint32_t element : row.elements) row.shares.push_back(std::exchange(share_[element], 0));
  return row;
}

}  // namespace hemitex::radiosity
