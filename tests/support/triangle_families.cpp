#include "tests/support/triangle_families.h"

#include <algorithm>
#include <cmath>

namespace hemitex::tests {
namespace {

constexpr int resolution = 16;
constexpr int mapSize = 19;

using Corners = std::array<glm::vec3, 3>;
using Coordinates = std::array<glm::vec2, 3>;

/// A point whose projection is (p.x, p.y) at depth p.z; exact if p.z is a power of two.
glm::vec3 seenAt(const glm::vec3& p) { return {p.x * p.z, p.y * p.z, p.z}; }

glm::vec3 anywhere(std::mt19937& random, float low = 0.5f, float high = 4) {
  return seenAt({uniform(random, -1.3f, 1.3f), uniform(random, -1.3f, 1.3f), uniform(random, low, high)});
}

Coordinates anyCoordinates(std::mt19937& random) {
  Coordinates t;
  for (glm::vec2& p : t) p = {uniform(random, -0.2f, 1.2f), uniform(random, -0.2f, 1.2f)};
  return t;
}

DrawnCase emptyCase() {
  DrawnCase result{plainList(), frontFace(resolution)};
  result.list.indexMaps.push_back(countingMap(mapSize, mapSize));
  return result;
}

/// Adds a triangle as a draw of its own; every other one has a back item ID.
void add(DrawnCase& result, const Corners& p, const Coordinates& t) {
  const auto number = static_cast<raster::ItemId>(result.list.draws.size());
  addDraw(result.list, number << 16, number % 2 == 0 ? std::optional<raster::ItemId>() : 0xfffffffe, 0);
  addTriangle(result.list, {p[0], p[1], p[2]}, {t[0], t[1], t[2]});
}

DrawnCase generic(std::mt19937& random) {
  DrawnCase result = emptyCase();
  for (int k = 0; k < 4; ++k)
    add(result, {anywhere(random), anywhere(random), anywhere(random)}, anyCoordinates(random));
  return result;
}

/// Triangles whose height is down to 1e-7 of their length.
DrawnCase sliver(std::mt19937& random) {
  DrawnCase result = emptyCase();
  for (int k = 0; k < 4; ++k) {
    const glm::vec3 a = anywhere(random), b = anywhere(random);
    const float height = std::array<float, 4>{1e-1f, 1e-3f, 1e-5f, 1e-7f}[random() % 4];
    const float t = uniform(random, 0, 1);
    const glm::vec3 c = a + t * (b - a) + height * anywhere(random);
    add(result, {a, b, c}, anyCoordinates(random));
  }
  return result;
}

/// Corners on samples, on half sub-pixels (where snapping rounds to even) and on sub-pixels; edges through samples.
DrawnCase onSamples(std::mt19937& random) {
  DrawnCase result = emptyCase();
  for (int k = 0; k < 4; ++k) {
    Corners p;
    for (glm::vec3& corner : p) {
      const float unit = std::array<float, 4>{1.0f / 16, 1.0f / 32, 1.0f / 4096, 1.0f / 8192}[random() % 4];
      const auto grid = [&] { return std::nearbyint(uniform(random, -1.3f, 1.3f) / unit) * unit; };
      const float x = grid(), y = grid();
      corner = seenAt({x, y, std::array<float, 3>{0.5f, 1, 2}[random() % 3]});
    }
    add(result, p, anyCoordinates(random));
  }
  return result;
}

/// Walls seen straight on with texel borders through samples: exactly if the map has 16 texels along a side, to
/// binary32 precision if it has 19.
DrawnCase bordersOnSamples(std::mt19937& random) {
  DrawnCase result = emptyCase();
  const int size = random() % 2 == 0 ? 16 : mapSize;
  result.list.indexMaps[0] = countingMap(size, size);
  const float w = std::array<float, 3>{0.5f, 1, 4}[random() % 3];
  // u = (i + c)/size at the sample of column i, with c a multiple of 1/2: either all samples are on a border, or none.
  const auto coordinate = [size](float x, int shift) {
    return static_cast<float>((static_cast<double>(x) * 8 + 8 - 0.5 + shift * 0.5) / size);
  };
  const int shiftU = static_cast<int>(random() % 8), shiftV = static_cast<int>(random() % 8);
  Corners p;
  Coordinates t;
  for (std::size_t k = 0; k < 3; ++k) {
    const float x = std::nearbyint(uniform(random, -8, 8)) / 4, y = std::nearbyint(uniform(random, -8, 8)) / 4;
    p[k] = seenAt({x, y, w});
    t[k] = {coordinate(x, shiftU), coordinate(y, shiftV)};
  }
  add(result, p, t);
  return result;
}

/// Corners in front of, on and behind the near plane.
DrawnCase nearClipped(std::mt19937& random) {
  DrawnCase result = emptyCase();
  result.face.nearDistance = 0.25f;
  for (int k = 0; k < 4; ++k) {
    Corners p;
    for (glm::vec3& corner : p) {
      corner = {uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -1, 2)};
      if (random() % 8 == 0) corner.z = result.face.nearDistance;
    }
    add(result, p, anyCoordinates(random));
  }
  return result;
}

/// Triangles that extend far beyond the guard band.
DrawnCase guardBandClipped(std::mt19937& random) {
  DrawnCase result = emptyCase();
  for (int k = 0; k < 4; ++k) {
    Corners p;
    for (glm::vec3& corner : p) {
      const float size = std::array<float, 3>{1, 30, 1000}[random() % 3];
      corner = seenAt({uniform(random, -size, size), uniform(random, -size, size), uniform(random, 0.1f, 3)});
      if (random() % 6 == 0) corner.x = (random() % 2 == 0 ? 8 : -8) * corner.z;
    }
    add(result, p, anyCoordinates(random));
  }
  return result;
}

/// Depths that differ by a factor of a million.
DrawnCase steep(std::mt19937& random) {
  DrawnCase result = emptyCase();
  for (int k = 0; k < 4; ++k) {
    Corners p;
    for (glm::vec3& corner : p)
      corner = seenAt({uniform(random, -1.3f, 1.3f), uniform(random, -1.3f, 1.3f), random() % 2 == 0 ? 1e-2f : 1e4f});
    add(result, p, anyCoordinates(random));
  }
  return result;
}

/// Overlapping triangles of one plane, in random order; some have exact ties everywhere.
DrawnCase coplanar(std::mt19937& random) {
  DrawnCase result = emptyCase();
  const float slope = std::array<float, 3>{0, 0.25f, 0.3f}[random() % 3];
  const auto point = [&] {
    const float x = std::nearbyint(uniform(random, -20, 20)) / 8, y = std::nearbyint(uniform(random, -20, 20)) / 8;
    return glm::vec3(x, y, 1.5f + slope * x);
  };
  for (int k = 0; k < 4; ++k) add(result, {point(), point(), point()}, anyCoordinates(random));
  return result;
}

/// The same scene a million units away, where binary32 positions have a resolution of a sixteenth of a unit.
DrawnCase offset(std::mt19937& random) {
  DrawnCase result = emptyCase();
  const glm::vec3 away(1e6f, -1e6f, 1e6f);
  result.face.eye = away;
  for (int k = 0; k < 4; ++k) {
    Corners p;
    for (glm::vec3& corner : p) corner = away + anywhere(random);
    add(result, p, anyCoordinates(random));
  }
  return result;
}

}  // namespace

std::vector<TriangleFamily> triangleFamilies() {
  return {{"generic", generic, 4},
          {"sliver", sliver, 4},
          {"corners and edges on samples", onSamples, 4},
          {"texel borders on samples", bordersOnSamples, 1},
          {"near plane", nearClipped, 4},
          {"guard band", guardBandClipped, 4},
          {"depth ratios of a million", steep, 4},
          {"coplanar overlaps", coplanar, 4},
          {"a million units from zero", offset, 4}};
}

}  // namespace hemitex::tests
