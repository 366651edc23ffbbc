#include "radiosity/form_factors/patch_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/form_factors/polygon_form_factor.h"

namespace hemitex::radiosity {
namespace {

/// Elements get more points until these are this number of times nearer together than the patch is.
constexpr double gapsPerSpacing = 4;
/// Maximum number of points along the side of an element.
constexpr int maxSide = 16;
/// Surfaces of more triangles have one point per element, because each point visits all of them.
constexpr std::size_t manyTriangles = 64;
/// Points along the side of a patch, which rays aim at.
constexpr int aimedSide = 4;
/// The order of 4 x 4 points, row by row: any four in a row are from different quarters.
constexpr std::array<std::size_t, 16> quarterOrder{0, 2, 8, 10, 5, 7, 13, 15, 1, 3, 9, 11, 4, 6, 12, 14};

glm::dvec3 positionAt(const Triangle& triangle, const glm::dvec2& weights) {
  const auto& [a, b, c] = triangle.position;
  return a + weights.x * (b - a) + weights.y * (c - a);
}

double areaOf(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return glm::length(sum) / 2;
}

/// The corners of a rectangle of the chart, in texels, where the plane of a triangle continues; counter-clockwise as
/// seen from the front of the triangle.
std::array<glm::dvec3, 4> cornersOf(const Triangle& triangle, const Grid& grid, const glm::dvec2& low,
                                    const glm::dvec2& high) {
  const std::array<glm::dvec2, 3> chart = inTexels(triangle, grid.columns, grid.rows);
  const glm::dvec2 along1 = chart[1] - chart[0], along2 = chart[2] - chart[0];
  const double determinant = along1.x * along2.y - along1.y * along2.x;
  const auto at = [&](double column, double row) {
    const glm::dvec2 from = glm::dvec2(column, row) - chart[0];
    return positionAt(
        triangle,
        glm::dvec2(from.x * along2.y - from.y * along2.x, along1.x * from.y - along1.y * from.x) / determinant);
  };
  std::array<glm::dvec3, 4> corners{at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)};
  if (determinant < 0) std::swap(corners[1], corners[3]);
  return corners;
}

Plane planeOf(const Triangle& triangle) {
  const glm::dvec3 n = normal(triangle);
  return {n, glm::dot(n, triangle.position[0])};
}

/// The exposed parts of a surface in a rectangle of its chart.
std::vector<PatchShape::Polygon> polygonsIn(const Surface& surface, const Grid& grid, const glm::dvec2& low,
                                            const glm::dvec2& high) {
  std::vector<PatchShape::Polygon> polygons;
  const auto add = [&](std::uint32_t number, const Piece& piece) {
    if (!(share(piece) > 0)) return;
    const Triangle& triangle = surface.triangles[number];
    PatchShape::Polygon polygon{{}, planeOf(triangle)};
    for (std::size_t i = 0; i < piece.size; ++i)
      polygon.corners.push_back(positionAt(triangle, piece.corners[i].weight));
    polygons.push_back(std::move(polygon));
  };
  if (hasCutTexel(texelGrid(grid), low, high)) {
    forEachExposedPiece(surface, texelGrid(grid), low, high,
                        [&](std::size_t, std::uint32_t triangle, const Piece& piece) { add(triangle, piece); });
    return polygons;
  }
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
    add(t, clippedTo(wholeTriangle(inTexels(surface.triangles[t], grid.columns, grid.rows)), low, high));
  return polygons;
}

/// The rectangle, if the polygons lie in one plane and fill it: fewer corners take less time.
std::optional<PatchShape::Polygon> asOne(const std::vector<PatchShape::Polygon>& polygons,
                                         const std::array<glm::dvec3, 4>& rectangle) {
  double area = 0;
  for (const PatchShape::Polygon& polygon : polygons) {
    if (glm::dot(polygon.plane.normal, polygons[0].plane.normal) < 1 - 1e-12) return std::nullopt;
    area += areaOf(polygon.corners);
  }
  const double whole = areaOf(rectangle);
  if (std::abs(area - whole) > 1e-9 * whole) return std::nullopt;
  return PatchShape::Polygon{{rectangle.begin(), rectangle.end()}, polygons[0].plane};
}

AreaSample sampleAt(const Scene& scene, std::uint32_t surface, const ShootingBlock& block) {
  return {block.centre, eyeOver(scene, surface, block.centre), block.area};
}

/// The centres of side x side parts of a rectangle.
std::vector<AreaSample> samplesIn(const Scene& scene, const Discretization& discretization, Patch rectangle, int side) {
  rectangle.points = side;
  std::vector<AreaSample> samples;
  for (const ShootingBlock& block : shootingBlocks(scene, discretization, rectangle))
    samples.push_back(sampleAt(scene, rectangle.surface, block));
  return samples;
}

/// The texel or leaf of an element as a rectangle.
Patch rectangleOf(const Discretization& discretization, std::uint32_t number) {
  const Element& element = discretization.elements[number];
  const Leaf leaf = leafOf(discretization.grids[element.surface], element.texel);
  return {.surface = element.surface, .column = leaf.column, .row = leaf.row, .width = leaf.side, .height = leaf.side};
}

PatchShape::Polygon placed(const PatchShape::Polygon& polygon, const Instance& instance) {
  PatchShape::Polygon result;
  result.plane.normal = instance.sign * polygon.plane.normal;
  for (const glm::dvec3& corner : polygon.corners) result.corners.push_back(instance(corner));
  if (instance.reflects()) std::reverse(result.corners.begin(), result.corners.end());
  result.plane.offset = glm::dot(result.plane.normal, result.corners[0]);
  return result;
}

PatchShape placed(const PatchShape& shape, const Instance& instance) {
  PatchShape result;
  result.area = shape.area;
  for (const PatchShape::Polygon& polygon : shape.polygons) {
    result.polygons.push_back(placed(polygon, instance));
    for (const glm::dvec3& corner : result.polygons.back().corners) result.bounds.include(corner);
  }
  for (AreaSample sample : shape.samples) {
    sample.point.position = instance(sample.point.position);
    sample.point.normal *= instance.sign;
    sample.eye = instance(sample.eye);
    result.samples.push_back(sample);
  }
  return result;
}

double distanceTo(const Bounds& bounds, const glm::dvec3& point) {
  return glm::length(glm::max(glm::max(bounds.low - point, point - bounds.high), glm::dvec3(0)));
}

/// The points along the side of an element that its distance from a patch asks for.
int sideFor(const Bounds& element, const Bounds& patch) {
  const double size = glm::length(element.high - element.low);
  const double gap = distanceTo(patch, (element.low + element.high) / 2.0);
  int side = 1;
  while (side < maxSide && size * gapsPerSpacing > gap * side) side *= 2;
  return side;
}

double unblocked(const PatchShape& shape, const SurfacePoint& from) {
  double sum = 0;
  for (const PatchShape::Polygon& polygon : shape.polygons)
    if (glm::dot(polygon.plane.normal, from.position) > polygon.plane.offset)
      sum += pointToPolygon(from.position, from.normal, polygon.corners);
  return sum;
}

/// The light from one point of a patch to a point, without blockers, in any unit.
double lightBetween(const AreaSample& from, const AreaSample& to) {
  const glm::dvec3 way = to.point.position - from.point.position;
  const double squared = glm::dot(way, way);
  const double cosines = glm::dot(from.point.normal, way) * -glm::dot(to.point.normal, way);
  return squared > 0 && glm::dot(from.point.normal, way) > 0 ? std::max(0.0, cosines) * from.area / (squared * squared)
                                                             : 0;
}

/// The share of a patch's light that reaches a point.
double visibleShare(const PatchShape& shape, const AreaSample& to, const RayTree& tree) {
  double all = 0, visible = 0;
  for (const AreaSample& from : shape.samples) {
    const double light = lightBetween(from, to);
    all += light;
    if (light > 0 && !tree.isBlocked(to.eye, from.eye)) visible += light;
  }
  return all > 0 ? visible / all : 0;
}

/// The visible part of the mean form factor from points, of which `factors` are the form factors without blockers. One
/// ray per point tells where all or nothing is visible; near patches have points enough for one ray each.
double visibleFormFactor(const PatchShape& shape, const std::vector<AreaSample>& samples,
                         const std::vector<double>& factors, const RayTree& tree) {
  double all = 0, visible = 0, area = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    area += samples[i].area;
    if (!(factors[i] > 0)) continue;
    all += samples[i].area * factors[i];
    const AreaSample& aimed = shape.samples[i % shape.samples.size()];
    if (!tree.isBlocked(samples[i].eye, aimed.eye)) visible += samples[i].area * factors[i];
  }
  if (visible == 0 || visible == all || samples.size() > shape.samples.size()) return visible / area;
  visible = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (factors[i] > 0) visible += samples[i].area * factors[i] * visibleShare(shape, samples[i], tree);
  return visible / area;
}

/// The centres of side x side squares of an element that have exposed area; its centre alone on surfaces of many
/// triangles.
std::vector<AreaSample> samplesOf(const Scene& scene, const Discretization& discretization,
                                  const SeeingElement& element, int side) {
  const Surface& surface = scene.surfaces[discretization.elements[element.number].surface];
  if (surface.triangles.size() > manyTriangles) return {element.centre};
  std::vector<AreaSample> samples = samplesIn(scene, discretization, rectangleOf(discretization, element.number), side);
  return samples.empty() ? std::vector{element.centre} : samples;
}

}  // namespace

std::vector<PatchShape> shapesOf(const Scene& scene, const Discretization& discretization, const Patch& patch) {
  const Surface& surface = scene.surfaces[patch.surface];
  const Grid& grid = discretization.grids[patch.surface];
  const glm::dvec2 low(patch.column, patch.row), high = low + glm::dvec2(patch.width, patch.height);
  PatchShape shape;
  shape.polygons = polygonsIn(surface, grid, low, high);
  if (shape.polygons.size() > 1)
    if (auto one = asOne(shape.polygons, cornersOf(surface.triangles[discretization.triangleOf[patch.elements.front()]],
                                                   grid, low, high)))
      shape.polygons = {*std::move(one)};
  for (const PatchShape::Polygon& polygon : shape.polygons) shape.area += areaOf(polygon.corners);
  const std::vector<AreaSample> rows = samplesIn(scene, discretization, patch, aimedSide);
  if (rows.size() == quarterOrder.size())
    for (const std::size_t i : quarterOrder) shape.samples.push_back(rows[i]);
  else
    shape.samples = rows;
  if (shape.samples.empty()) return {};
  std::vector<PatchShape> shapes;
  for (const Instance& instance : scene.instances) shapes.push_back(placed(shape, instance));
  return shapes;
}

SeeingElement seeingElement(const Scene& scene, const Discretization& discretization, std::uint32_t number) {
  const Element& element = discretization.elements[number];
  const ShootingBlock whole{elementCentre(scene, discretization, number), element.area};
  SeeingElement result{number, sampleAt(scene, element.surface, whole), {}};
  result.quarters = samplesOf(scene, discretization, result, 2);
  const Patch rectangle = rectangleOf(discretization, number);
  const glm::dvec2 low(rectangle.column, rectangle.row);
  for (const glm::dvec3& corner :
       cornersOf(scene.surfaces[element.surface].triangles[discretization.triangleOf[number]],
                 discretization.grids[element.surface], low, low + static_cast<double>(rectangle.width)))
    result.bounds.include(corner);
  return result;
}

double formFactorTo(const PatchShape& shape, const Scene& scene, const Discretization& discretization,
                    const SeeingElement& element, const RayTree& tree, bool isClear) {
  const int side = sideFor(element.bounds, shape.bounds);
  if (isClear && side == 1) return unblocked(shape, element.centre.point);
  const std::vector<AreaSample> samples =
      side <= 2 ? element.quarters : samplesOf(scene, discretization, element, side);
  std::vector<double> factors;
  double sum = 0, area = 0;
  for (const AreaSample& sample : samples) {
    factors.push_back(unblocked(shape, sample.point));
    sum += sample.area * factors.back();
    area += sample.area;
  }
  return isClear || sum == 0 ? sum / area : visibleFormFactor(shape, samples, factors, tree);
}

}  // namespace hemitex::radiosity
