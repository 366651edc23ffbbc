#include "raster/kernels/small_triangle_kernels.h"

#include <algorithm>
#include <cmath>

#include "raster/kernels/interpolation_bounds.h"

namespace hemitex::raster {
namespace {

/// One value per corner of a triangle.
template <typename Value>
using Corners = std::array<Value, 3>;

double sum(const Corners<double>& values) { return (values[0] + values[1]) + values[2]; }

Corners<double> product(const Corners<double>& a, const Corners<double>& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}

double largestOf(const Corners<double>& values) { return std::max(std::max(values[0], values[1]), values[2]); }

/// Positions of corners relative to the sample of a pixel.
Corners<std::int32_t> fromSample(const Corners<std::int32_t>& snapped, int pixel) {
  const std::int32_t sample = 256 * pixel + 128;
  return {snapped[0] - sample, snapped[1] - sample, snapped[2] - sample};
}

/// The edges of a triangle of positive area: each the one opposite a corner, positive inside, with its value at the
/// origin and its change per pixel. `least` is the smallest value at covered samples: 0 for a left or a top edge,
/// else 1.
struct Edges {
  Corners<double> at, right, down, least;

  Edges(const Corners<std::int32_t>& x, const Corners<std::int32_t>& y) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
      at[k] = x[p] * y[q] - x[q] * y[p];
      right[k] = 256 * (y[p] - y[q]);
      down[k] = 256 * (x[q] - x[p]);
      least[k] = y[p] > y[q] || (y[p] == y[q] && x[q] > x[p]) ? 0 : 1;
    }
  }
  bool cover(int i, int j) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (at[k] + right[k] * i + down[k] * j < least[k]) return false;
    return true;
  }
};

/// A texture coordinate at the corners of a triangle, in texels. If all corners, and so all samples, have the same
/// texel, its middle stands for all positions.
struct Texels {
  Corners<double> position;
  double texel;
  bool isUniform;

  Texels(const Corners<double>& coordinate, int size) {
    Corners<double> texels;
    for (std::size_t k = 0; k < 3; ++k) {
      position[k] = coordinate[k] * size;
      texels[k] = std::max(std::min(std::floor(position[k]), size - 1.0), 0.0);
    }
    texel = texels[0];
    isUniform = texels[0] == texels[1] && texels[0] == texels[2];
    if (isUniform) position = {texel + 0.5, texel + 0.5, texel + 0.5};
  }

  double largest() const {
    return std::max(std::max(std::abs(position[0]), std::abs(position[1])), std::abs(position[2]));
  }
};

struct Weights {
  Corners<double> at, right, down;
};

void setPlane(const Weights& weights, const Corners<double>& values, std::uint32_t k, SmallPlanes& planes) {
  planes.at[k] = sum(product(weights.at, values));
  planes.right[k] = sum(product(weights.right, values));
  planes.down[k] = sum(product(weights.down, values));
}

/// The corners of a triangle.
struct SnappedCorners {
  Corners<std::int32_t> across, down;
  Corners<double> w, u, v;

  SnappedCorners(const SmallTriangles& triangles, std::uint32_t t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t corner = triangles.mesh.corners[k][triangles.part.firstTriangle + t];
      const glm::vec2& texcoord = triangles.mesh.texcoords[triangles.part.firstVertex + corner];
      across[k] = triangles.placed.across[corner];
      down[k] = triangles.placed.down[corner];
      w[k] = triangles.placed.w[corner];
      u[k] = texcoord.x;
      v[k] = texcoord.y;
    }
  }
  void swap(std::size_t a, std::size_t b) {
    std::swap(across[a], across[b]);
    std::swap(down[a], down[b]);
    std::swap(w[a], w[b]);
    std::swap(u[a], u[b]);
    std::swap(v[a], v[b]);
  }
  std::int32_t area() const {
    return (across[1] - across[0]) * (down[2] - down[0]) - (down[1] - down[0]) * (across[2] - across[0]);
  }
};

/// The samples in the bounds of a triangle.
struct Bounds {
  PixelRange columns, rows;

  Bounds(const SnappedCorners& at, const Scissor& part)
      : columns(samplesBetween(at.across[0], at.across[1], at.across[2], part.column, part.column + part.width)),
        rows(samplesBetween(at.down[0], at.down[1], at.down[2], part.row, part.row + part.height)) {}

  Edges edges(const SnappedCorners& at) const {
    return {fromSample(at.across, columns.first), fromSample(at.down, rows.first)};
  }
};

/// Whether a triangle covers one of the first two samples in the first two rows of its bounds.
bool coversAny(SnappedCorners corners, const Scissor& part) {
  if (corners.area() < 0) corners.swap(1, 2);
  const Edges edges = Bounds(corners, part).edges(corners);
  return edges.cover(0, 0) || edges.cover(1, 0) || edges.cover(0, 1) || edges.cover(1, 1);
}

/// Sets up entry k. 1/w is the sum of edge values e / w over the area. Each term of a plane has at most thirteen
/// roundings, from w to its value at a sample. The error is below 16 units of roundoff of the sum of the absolute
/// terms.
void setUpEntry(const SmallTriangles& triangles, std::uint32_t k, const Scissor& part, SmallSetup& setup) {
  SnappedCorners corners(triangles, static_cast<std::uint32_t>(setup.triangles[k]));
  const std::int32_t area = corners.area();
  if (area < 0) {
    setup.negative |= 1U << k;
    corners.swap(1, 2);
  }
  const Bounds bounds(corners, part);
  const int width = bounds.columns.end - bounds.columns.first, height = bounds.rows.end - bounds.rows.first;
  const Edges edges = bounds.edges(corners);
  const Corners<double>& w = corners.w;
  const double inverse = 1 / (((w[0] * w[1]) * w[2]) * std::abs(area));
  const Corners<double> depths{inverse * (w[1] * w[2]), inverse * (w[2] * w[0]), inverse * (w[0] * w[1])};
  Corners<double> absolute;
  for (std::size_t e = 0; e < 3; ++e)
    absolute[e] =
        (std::abs(edges.at[e]) + std::abs(edges.right[e]) * (width - 1)) + std::abs(edges.down[e]) * (height - 1);
  const double error = 16 * unitRoundoff * (sum(product(absolute, depths)) * largestOf(w));
  const bool isThin = area != 0 && !(error < depthError);
  if (isThin) setup.thin |= 1U << k;
  setup.firstColumn[k] = bounds.columns.first;
  setup.columns[k] = width;
  setup.firstRow[k] = bounds.rows.first;
  setup.rows[k] = area == 0 || isThin ? 0 : height;
  for (std::size_t e = 0; e < 3; ++e) {
    setup.edges[e].at[k] = edges.at[e] - edges.least[e];
    setup.edges[e].right[k] = edges.right[e];
    setup.edges[e].down[k] = edges.down[e];
  }
  const Weights weights{product(edges.at, depths), product(edges.right, depths), product(edges.down, depths)};
  setPlane(weights, {1, 1, 1}, k, setup.inverseDepth);
  const Texels column(corners.u, triangles.columns), row(corners.v, triangles.rows);
  setPlane(weights, column.position, k, setup.column);
  setPlane(weights, row.position, k, setup.row);
  // Over w, the plane has the error bound above times the largest position. w adds another, and the product rounds.
  setup.clear[k] = 0.5 - 3 * depthError * std::max(column.largest(), row.largest());
  if (column.isUniform && row.isUniform) setup.uniform |= 1U << k;
  setup.texel[k] = static_cast<std::int32_t>(row.texel * triangles.columns + column.texel);
}

void setUp(const SmallTriangles& triangles, const Scissor& part, SmallSetup& setup) {
  setup.count = setup.thin = setup.negative = setup.uniform = 0;
  for (std::uint32_t t = 0; t < triangles.part.triangles; ++t) {
    if ((triangles.set >> t & 1) == 0) continue;
    if ((triangles.tiny >> t & 1) != 0 && !coversAny({triangles, t}, part)) continue;
    setup.triangles[setup.count++] = static_cast<std::int32_t>(t);
  }
  for (std::uint32_t k = 0; k < setup.count; ++k) setUpEntry(triangles, k, part, setup);
}

double valueAt(const SmallPlanes& planes, std::uint32_t k, int i, int j) {
  return (planes.at[k] + planes.down[k] * j) + planes.right[k] * i;
}

/// Returns false if the texel is not resolved.
bool findId(const SmallSetup& setup, const SmallIds& ids, std::uint32_t k, int i, int j, double inverseDepth,
            ItemId& id) {
  if ((ids.textured >> k & 1) == 0) {
    id = ids.ids[k];
    return true;
  }
  const double w = 1 / inverseDepth;
  const double across = valueAt(setup.column, k, i, j) * w, along = valueAt(setup.row, k, i, j) * w;
  const auto isClear = [&](double position) {
    return std::abs((position - std::floor(position)) - 0.5) < setup.clear[k];
  };
  if (!isClear(across) || !isClear(along)) return false;
  const double column = std::max(std::min(std::floor(across), ids.columns - 1), 0.0);
  const double row = std::max(std::min(std::floor(along), ids.rows - 1), 0.0);
  const auto texel = static_cast<ItemId>(row * ids.columns + column);
  id = ids.ids[k] + (ids.map != nullptr ? ids.map[texel] : texel);
  return true;
}

void drawSample(const SmallSetup& setup, const SmallIds& ids, std::uint32_t k, int i, int j, std::uint32_t number,
                DepthBuffer& buffer, UndecidedSamples& undecided) {
  for (const SmallPlanes& edge : setup.edges)
    if (valueAt(edge, k, i, j) < 0) return;
  const Pixel pixel{setup.firstColumn[k] + i, setup.firstRow[k] + j};
  const double inverseDepth = valueAt(setup.inverseDepth, k, i, j);
  const std::size_t at = buffer.pixelAt(pixel.column, pixel.row);
  const DepthTest test = offerDepth(inverseDepth, number, at, buffer);
  if (test == DepthTest::Hidden) return;
  if (test == DepthTest::Undecided || !findId(setup, ids, k, i, j, inverseDepth, buffer.id[at]))
    undecided.add({k, pixel});
}

void draw(const SmallSetup& setup, const SmallIds& ids, std::uint32_t firstNumber, DepthBuffer& buffer,
          UndecidedSamples& undecided) {
  for (std::uint32_t k = 0; k < setup.count; ++k) {
    const std::uint32_t number = firstNumber + static_cast<std::uint32_t>(setup.triangles[k]);
    for (int j = 0; j < setup.rows[k]; ++j)
      for (int i = 0; i < setup.columns[k]; ++i) drawSample(setup, ids, k, i, j, number, buffer, undecided);
  }
}

}  // namespace

void UndecidedSamples::add(const SmallSample& sample) { samples.push_back(sample); }

template <>
const SmallTriangleKernels& scalarKernels<SmallTriangleKernels>() {
  static const SmallTriangleKernels kernels{"scalar", setUp, draw};
  return kernels;
}

}  // namespace hemitex::raster
