// The bounds of ViewBounds hold for each triangle inside a box.
#include "raster/culling/frustum_culling.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "raster/culling/triangle_cluster.h"
#include "raster/kernels/interpolation_bounds.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using namespace hemitex::raster;

namespace {

/// Small clusters far away, near, and around the eye; corners lie on the faces of their boxes.
DrawList clouds() {
  DrawList list = tests::plainList();
  list.indexMaps.push_back({1, 1, {0}});
  std::mt19937 random(8);
  const auto point = [&](float size) {
    return glm::vec3(tests::uniform(random, -size, size), tests::uniform(random, -size, size),
                     tests::uniform(random, -size, size));
  };
  for (ItemId draw = 0; draw < 600; ++draw) {
    tests::addDraw(list, draw, {}, 0);
    const glm::vec3 centre = point(6);
    const float size = 0.001F * static_cast<float>(1U << (random() % 11));
    for (int t = 0; t < 4; ++t)
      tests::addTriangle(list, {centre + point(size), centre + point(size), centre + point(size)});
  }
  return list;
}

bool isInside(const Scissor& part, const ScreenTriangle& triangle) {
  return triangle.firstColumn >= part.column && triangle.endColumn <= part.column + part.width &&
         triangle.firstRow >= part.row && triangle.endRow <= part.row + part.height;
}

/// The largest 1/w at a covered sample, in double precision.
double nearestSample(const ScreenTriangle& triangle) {
  double nearest = 0;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row)
    for (int column = triangle.firstColumn; column < triangle.endColumn; ++column) {
      const EdgeValues edge = edgeValues(triangle, column, row);
      if (edge[0] >= 0 && edge[1] >= 0 && edge[2] >= 0) nearest = std::max(nearest, inverseDepthAt(triangle, edge));
    }
  return nearest;
}

}  // namespace

TEST_CASE("ViewBounds::placeOf bounds the pixels and the depth of the triangles in a box", "[bounds]") {
  const DrawList list = clouds();
  std::mt19937 random(6);
  int triangles = 0, bounded = 0;
  double area = 0, least = 0, loosest = 0;
  for (int view = 0; view < 30; ++view) {
    Face face = tests::frontFace(view % 2 == 0 ? 64 : 256);
    if (view % 3 == 0) face.x *= -2.0F;
    if (view % 5 == 0) std::swap(face.y, face.w);
    if (view % 7 == 0) face.w *= 0.25F;
    if (view % 4 == 0) face.y += 0.3F * face.x;
    face.eye = {tests::uniform(random, -2, 2), tests::uniform(random, -2, 2), 0};
    const ViewBounds bounds(face);
    for (const Cluster& cluster : clustersOf(list)) {
      const BoxPlace place = bounds.placeOf(cluster.box);
      std::vector<ScreenTriangle> found;
      appendScreenTriangles(list, face, cluster.runs, {}, found);
      double nearest = 0;
      for (const ScreenTriangle& triangle : found) {
        ++triangles;
        CHECK(isInside(place.part, triangle));
        nearest = std::max(nearest, nearestSample(triangle));
      }
      CHECK((found.empty() || nearest < place.inverseDepth));
      if (nearest == 0 || place.inverseDepth == std::numeric_limits<double>::infinity()) continue;
      ++bounded;
      area += place.part.width * place.part.height;
      least += coveredBounds(list, {&cluster, 1}, face).width * coveredBounds(list, {&cluster, 1}, face).height;
      loosest += place.inverseDepth / nearest;
    }
  }
  CHECK(triangles > 1000);
  CHECK(bounded > 500);
  // The bounds must also be tight: on average, in pixels and in depth.
  CHECK(area < 1.6 * least);
  CHECK(loosest < 1.2 * bounded);
}

TEST_CASE("ViewBounds::placeOf holds the samples that corners of the box snap onto, and no others", "[bounds]") {
  // A flat box seen straight on. It begins in the middle of pixel 40, less a given fraction of a sub-pixel.
  const Face face = tests::frontFace(64);
  const auto partOf = [&face](double subPixels, double pixels) {
    const double begin = (40.5 + subPixels / 256) / 32 - 1, end = begin + pixels / 32;
    return ViewBounds(face).placeOf({{begin, begin, 1}, {end, end, 1}}).part;
  };
  // A corner up to half a sub-pixel beyond the sample snaps onto it.
  for (const double subPixels : {-2.0, 0.0, 0.49}) {
    CHECK(partOf(subPixels, 0.25).column == 40);
    CHECK(partOf(subPixels, 0.25).width == 1);
    CHECK(partOf(subPixels, 3.25).height == 4);
  }
  CHECK(partOf(2, 0.25).width == 0);
  CHECK(partOf(2, 3.25).row == 41);
  CHECK(partOf(2, 3.25).height == 3);
}

TEST_CASE("ViewBounds holds where the vertex stage computes with subnormal binary32 numbers", "[bounds]") {
  for (const int exponent : {-130, -144, -146, -147}) {
    DrawList list = clouds();
    const float scale = std::ldexp(1.0F, exponent);
    for (glm::vec3& position : list.positions) position *= scale;
    std::mt19937 random(6);
    const auto point = [&](float size) {
      return glm::vec3(tests::uniform(random, -size, size), tests::uniform(random, -size, size),
                       tests::uniform(random, -size, size));
    };
    int samples = 0, outside = 0;
    for (int view = 0; view < 20; ++view) {
      Face face = tests::frontFace(64);
      face.w = glm::normalize(point(1));
      face.x = glm::normalize(glm::cross(face.w, point(1)));
      face.y = glm::cross(face.w, face.x);
      face.eye = scale * point(2);
      face.nearDistance = std::numeric_limits<float>::denorm_min();
      const ViewBounds bounds(face);
      for (const Cluster& cluster : clustersOf(list)) {
        const BoxPlace place = bounds.placeOf(cluster.box);
        std::vector<ScreenTriangle> found;
        appendScreenTriangles(list, face, cluster.runs, {}, found);
        for (const ScreenTriangle& triangle : found) {
          const double nearest = nearestSample(triangle);
          if (nearest == 0) continue;
          ++samples;
          const bool isBounded =
              bounds.mayShow(cluster.box) && isInside(place.part, triangle) && nearest < place.inverseDepth;
          outside += isBounded ? 0 : 1;
        }
      }
    }
    INFO("2^" << exponent);
    CHECK(samples > 500);
    CHECK(outside == 0);
  }
}

TEST_CASE("ViewBounds::mayShow is false behind the near plane and beside the view, and true inside", "[bounds]") {
  const ViewBounds bounds(tests::frontFace(64));
  const auto widthOf = [&bounds](const glm::dvec3& low, const glm::dvec3& high) {
    return bounds.placeOf({low, high}).part.width;
  };
  CHECK(widthOf({-1, -1, -2}, {1, 1, 0}) == 0);
  CHECK(widthOf({3, -1, -2}, {4, 1, 2}) == 0);
  CHECK(widthOf({3, -1, 1}, {4, 1, 2}) == 0);
  CHECK(widthOf({-1, -1, -2}, {1, 1, 2}) == 64);
}

TEST_CASE("ViewBounds lets a box with a value that is not finite be anywhere in the view", "[bounds]") {
  const double infinity = std::numeric_limits<double>::infinity();
  const Face face = tests::frontFace(64);
  const Box box{glm::dvec3(-infinity), glm::dvec3(infinity)};
  const BoxPlace place = ViewBounds(face).placeOf(box);
  CHECK(ViewBounds(face).mayShow(box));
  CHECK(place.part.width == 64);
  CHECK(place.part.height == 64);
  CHECK(place.inverseDepth == infinity);
}
