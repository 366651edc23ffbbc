#include "reference/conformance/verdict/reduction.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <set>
#include <utility>

namespace hemitex::reference {
namespace {

using Fails = std::function<bool(const TestVector&)>;

/// New consecutive numbers in the order of first use.
using Numbers = std::map<std::uint32_t, std::uint32_t>;

/// The new number, and whether it is new.
std::pair<std::uint32_t, bool> renumber(Numbers& numbers, std::uint32_t old) {
  const auto [place, isNew] = numbers.try_emplace(old, static_cast<std::uint32_t>(numbers.size()));
  return {place->second, isNew};
}

/// The list with only these triangles, given in draw order, and with the draws and index maps that they use. Triangles
/// that pixels number become draws of their own, so that each keeps its number.
raster::DrawList withTriangles(const raster::DrawList& list, std::span<const DrawnTriangle> triangles) {
  const bool areNumbered = list.value == raster::PixelValue::TriangleNumbers;
  raster::DrawList result = list;
  result.indices.clear();
  result.indexMaps.clear();
  result.draws.clear();
  Numbers draws, maps;
  for (const DrawnTriangle& each : triangles) {
    if (renumber(draws, each.draw).second || areNumbered) {
      raster::Draw draw = list.draws[each.draw];
      if (areNumbered) draw.offset = triangleNumber(draw, each.triangle);
      draw.first = static_cast<std::uint32_t>(result.indices.size());
      draw.count = 0;
      if (draw.indexMap) {
        const auto [map, isNew] = renumber(maps, static_cast<std::uint32_t>(*draw.indexMap));
        if (isNew) result.indexMaps.push_back(list.indexMaps[static_cast<std::size_t>(*draw.indexMap)]);
        draw.indexMap = static_cast<int>(map);
      }
      result.draws.push_back(draw);
    }
    const auto corners = list.indices.begin() + 3 * static_cast<std::ptrdiff_t>(each.triangle);
    result.indices.insert(result.indices.end(), corners, corners + 3);
    result.draws.back().count += 3;
  }
  return result;
}

/// The list without vertices that no triangle uses.
raster::DrawList withUsedVertices(const raster::DrawList& whole) {
  raster::DrawList list = whole;
  removeVertices(list);
  Numbers vertices;
  for (std::uint32_t& index : list.indices) {
    const auto [vertex, isNew] = renumber(vertices, index);
    if (isNew) addVertex(list, whole, index);
    index = vertex;
  }
  return list;
}

using Change = std::function<void(TestVector&)>;

/// Changes the vector if it fails then.
bool replaceBy(TestVector& vector, const Fails& fails, const Change& change) {
  TestVector smaller = vector;
  change(smaller);
  if (!fails(smaller)) return false;
  vector = std::move(smaller);
  return true;
}

bool keepOneFace(TestVector& vector, const Fails& fails) {
  if (vector.faces.size() == 1) return false;
  for (std::size_t f = 0; f < vector.faces.size(); ++f)
    if (replaceBy(vector, fails, [f](TestVector& smaller) { smaller.faces = {VectorFace(smaller.faces[f])}; }))
      return true;
  return false;
}

bool removeTriangles(TestVector& vector, const Fails& fails) {
  const std::vector<DrawnTriangle> all = drawnTriangles(vector.list);
  TestVector smaller = vector;
  const auto kept = fewestTriangles(all, [&](std::span<const DrawnTriangle> each) {
    smaller.list = withTriangles(vector.list, each);
    return fails(smaller);
  });
  if (kept.size() == all.size()) return false;
  vector.list = withTriangles(vector.list, kept);
  return true;
}

/// Rows or columns, from the first to before the last.
struct Interval {
  int first = 0, last = 0;
  int size() const { return last - first; }
};

/// Removes half of an interval at one end or the other, then a quarter, and so on, while `keep` takes the rest.
/// Returns whether it removed anything.
bool shrink(Interval& interval, const std::function<bool(const Interval&)>& keep) {
  bool isSmaller = false;
  for (int run = interval.size() / 2; run > 0 && interval.size() > 1;) {
    run = std::min(run, interval.size() - 1);
    const std::array<Interval, 2> rests{{{interval.first, interval.last - run}, {interval.first + run, interval.last}}};
    const auto rest = std::find_if(rests.begin(), rests.end(), keep);
    if (rest == rests.end()) {
      run /= 2;
    } else {
      interval = *rest;
      isSmaller = true;
    }
  }
  return isSmaller;
}

/// Shrinks columns, then rows. `change` gives a copy of the vector the columns and rows that stay.
bool shrinkBoth(TestVector& vector, const Fails& fails, Interval columns, Interval rows,
                const std::function<void(TestVector&, const Interval&, const Interval&)>& change) {
  const auto keep = [&](const Interval& c, const Interval& r) {
    return replaceBy(vector, fails, [&](TestVector& smaller) { change(smaller, c, r); });
  };
  const bool isNarrower = shrink(columns, [&](const Interval& each) { return keep(each, rows); });
  return shrink(rows, [&](const Interval& each) { return keep(columns, each); }) || isNarrower;
}

bool removePixels(TestVector& vector, const Fails& fails) {
  bool isSmaller = false;
  for (std::size_t f = 0; f < vector.faces.size(); ++f) {
    const raster::Scissor whole = vector.faces[f].face.scissor;
    isSmaller |=
        shrinkBoth(vector, fails, {whole.column, whole.column + whole.width}, {whole.row, whole.row + whole.height},
                   [f](TestVector& smaller, const Interval& columns, const Interval& rows) {
                     smaller.faces[f].face.scissor = {columns.first, rows.first, columns.size(), rows.size()};
                   });
  }
  return isSmaller;
}

raster::IndexMap part(const raster::IndexMap& map, const Interval& columns, const Interval& rows) {
  raster::IndexMap result{columns.size(), rows.size(), {}};
  for (int row = rows.first; row < rows.last; ++row)
    for (int column = columns.first; column < columns.last; ++column)
      result.ids.push_back(map.ids[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                   static_cast<std::size_t>(column)]);
  return result;
}

bool removeTexels(TestVector& vector, const Fails& fails) {
  bool isSmaller = false;
  for (std::size_t m = 0; m < vector.list.indexMaps.size(); ++m) {
    const raster::IndexMap whole = vector.list.indexMaps[m];
    isSmaller |= shrinkBoth(vector, fails, {0, whole.width}, {0, whole.height},
                            [&](TestVector& smaller, const Interval& columns, const Interval& rows) {
                              smaller.list.indexMaps[m] = part(whole, columns, rows);
                            });
  }
  return isSmaller;
}

bool isDegenerate(const std::vector<std::uint32_t>& indices) {
  for (std::size_t k = 0; k < indices.size(); k += 3)
    if (indices[k] == indices[k + 1] || indices[k + 1] == indices[k + 2] || indices[k] == indices[k + 2]) return true;
  return false;
}

/// Two vertices become one by taking the place of the other.
bool mergeVertices(TestVector& vector, const Fails& fails) {
  bool isSmaller = false;
  const std::set<std::uint32_t> used(vector.list.indices.begin(), vector.list.indices.end());
  for (const std::uint32_t gone : used)
    for (const std::uint32_t other : used) {
      std::vector<std::uint32_t> merged = vector.list.indices;
      std::replace(merged.begin(), merged.end(), gone, other);
      if (merged == vector.list.indices || isDegenerate(merged)) continue;
      isSmaller |= replaceBy(vector, fails, [&](TestVector& smaller) { smaller.list.indices = merged; });
    }
  return isSmaller;
}

/// Removes all vertices that no triangle uses. If a fault needs their number, it removes those at the ends.
bool removeVertices(TestVector& vector, const Fails& fails) {
  const raster::DrawList smallest = withUsedVertices(vector.list);
  if (smallest.positions.size() == vector.list.positions.size()) return false;
  if (replaceBy(vector, fails, [&](TestVector& smaller) { smaller.list = smallest; })) return true;
  const raster::DrawList whole = vector.list;
  const auto used = std::minmax_element(whole.indices.begin(), whole.indices.end());
  Interval all{0, static_cast<int>(whole.positions.size())};
  return shrink(all, [&](const Interval& kept) {
    if (std::int64_t{*used.first} < kept.first || std::int64_t{*used.second} >= kept.last) return false;
    return replaceBy(vector, fails, [&](TestVector& smaller) {
      removeVertices(smaller.list);
      for (int v = kept.first; v < kept.last; ++v) addVertex(smaller.list, whole, static_cast<std::size_t>(v));
      for (std::size_t k = 0; k < whole.indices.size(); ++k)
        smaller.list.indices[k] = whole.indices[k] - static_cast<std::uint32_t>(kept.first);
    });
  });
}

// --- failures at a pixel ---

/// An error pixel of a face.
struct Failure {
  VectorFace face;  ///< its scissor rectangle is the pixel
  raster::ItemBuffer found;
  raster::ItemId expected;
  ErrorKind kind;
};

/// A pixel of a verdict: its face, and its index in the item buffer.
struct FacePixel {
  std::size_t face, pixel;
};

std::vector<FacePixel> errorsOf(const Verdict& verdict) {
  std::vector<FacePixel> errors;
  for (std::size_t f = 0; f < verdict.faces.size(); ++f)
    for (std::size_t pixel = 0; pixel < verdict.faces[f].pixels.size(); ++pixel)
      if (verdict.faces[f].pixels[pixel] == PixelVerdict::Error) errors.push_back({f, pixel});
  return errors;
}

ErrorPixel errorOf(const Failure& failure, const raster::DrawList& list) {
  const raster::Scissor& pixel = failure.face.face.scissor;
  return errorAt(list, failure.face, pixel.column, pixel.row, failure.found.ids[0]);
}

Failure failureAt(const TestVector& vector, const Verdict& verdict, const FacePixel& at) {
  const FaceVerdict& face = verdict.faces[at.face];
  const glm::ivec2 pixel = pixelAt(face.scissor, at.pixel);
  Failure failure{vector.faces[at.face], {1, 1, {face.found.ids[at.pixel]}}, face.expected.ids[at.pixel], {}};
  failure.face.face.scissor = {pixel.x, pixel.y, 1, 1};
  failure.kind = errorOf(failure, vector.list).kind;
  return failure;
}

/// At most `count` errors, spread evenly over all.
std::vector<Failure> sampleOfFailures(const TestVector& vector, const Verdict& verdict, std::size_t count) {
  const std::vector<FacePixel> errors = errorsOf(verdict);
  const std::size_t taken = std::min(count, errors.size());
  std::vector<Failure> failures;
  for (std::size_t k = 0; k < taken; ++k)
    failures.push_back(failureAt(vector, verdict, errors[k * errors.size() / taken]));
  return failures;
}

ErrorKind mostFrequentKind(const std::vector<Failure>& failures) {
  std::array<std::size_t, errorKindNames.size()> counts{};
  for (const Failure& failure : failures) ++counts[static_cast<std::size_t>(failure.kind)];
  return static_cast<ErrorKind>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

bool stillFails(const Failure& failure, const raster::DrawList& list, const DeviceProfile& profile) {
  TestVector vector;
  vector.list = list;
  vector.faces = {failure.face};
  if (!hasErrors(judge(vector, {&failure.found, 1}, profile))) return false;
  const ErrorPixel error = errorOf(failure, list);
  return error.kind == failure.kind && error.expected == failure.expected;
}

}  // namespace

std::vector<DrawnTriangle> fewestTriangles(std::vector<DrawnTriangle> kept,
                                           const std::function<bool(std::span<const DrawnTriangle>)>& fails) {
  std::size_t run = std::max<std::size_t>(kept.size() / 2, 1);
  for (bool removed = true; run > 1 || removed; run = std::max<std::size_t>(run / 2, 1)) {
    removed = false;
    for (std::size_t first = 0; first < kept.size();) {
      std::vector<DrawnTriangle> fewer = kept;
      const auto from = fewer.begin() + static_cast<std::ptrdiff_t>(first);
      fewer.erase(from, from + static_cast<std::ptrdiff_t>(std::min(run, kept.size() - first)));
      if (fails(fewer)) {
        kept = std::move(fewer);
        removed = true;
      } else {
        first += run;
      }
    }
  }
  return kept;
}

TestVector reduce(TestVector vector, const Fails& fails, std::size_t maxRuns) {
  struct OutOfRuns {};
  TestVector smallest = vector;
  const Fails failsWithin = [&, runs = std::size_t{0}](const TestVector& smaller) mutable {
    if (runs++ == maxRuns) throw OutOfRuns();
    if (!fails(smaller)) return false;
    smallest = smaller;
    return true;
  };
  try {
    // Triangles as they are; a device that fails only with strips or instances keeps them all.
    if (vector.source) replaceBy(vector, failsWithin, [](TestVector& smaller) { smaller.source.reset(); });
    for (bool isSmaller = true; isSmaller;) {
      isSmaller = keepOneFace(vector, failsWithin);
      if (vector.source) {
        isSmaller |= removePixels(vector, failsWithin);
        continue;
      }
      isSmaller |= removeTriangles(vector, failsWithin);
      isSmaller |= removePixels(vector, failsWithin);
      isSmaller |= removeTexels(vector, failsWithin);
      isSmaller |= mergeVertices(vector, failsWithin);
      isSmaller |= removeVertices(vector, failsWithin);
    }
  } catch (const OutOfRuns&) {
    // The passes would still build thousands of smaller vectors.
  }
  return smallest;
}

MinimalFailure minimize(const TestVector& vector, const Verdict& verdict, const DeviceProfile& profile) {
  assert(hasErrors(verdict));
  constexpr std::size_t sampled = 64, attempts = 8;
  std::vector<Failure> failures = sampleOfFailures(vector, verdict, sampled);
  const ErrorKind kind = mostFrequentKind(failures);
  std::erase_if(failures, [=](const Failure& failure) { return failure.kind != kind; });
  failures.resize(std::min(failures.size(), attempts));

  const std::vector<DrawnTriangle> all = drawnTriangles(vector.list);
  const Failure* best = nullptr;
  std::vector<DrawnTriangle> fewest;
  for (const Failure& failure : failures) {
    const auto fails = [&](std::span<const DrawnTriangle> kept) {
      return stillFails(failure, withUsedVertices(withTriangles(vector.list, kept)), profile);
    };
    const std::vector<DrawnTriangle> kept = fewestTriangles(all, fails);
    if (best && kept.size() >= fewest.size()) continue;
    best = &failure;
    fewest = kept;
  }

  MinimalFailure minimal{
      {vector.name, vector.catches, vector.origin, withUsedVertices(withTriangles(vector.list, fewest)), {best->face}},
      {},
      {1, 1, {best->expected}},
      best->found};
  minimal.error = errorOf(*best, minimal.vector.list);
  return minimal;
}

}  // namespace hemitex::reference
