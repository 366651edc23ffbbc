#include "reference/conformance/verdict/minimal_failure.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "reference/conformance/verdict/reduction.h"

namespace hemitex::reference {
namespace {

/// Draws may share indices, so a triangle number alone is ambiguous.
using DrawnTriangles = std::vector<DrawnTriangle>;

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

Failure failureAt(const TestVector& vector, const Verdict& verdict, const FacePixel& at) {
  const FaceVerdict& face = verdict.faces[at.face];
  const auto width = static_cast<std::size_t>(face.scissor.width);
  const int column = face.scissor.column + static_cast<int>(at.pixel % width);
  const int row = face.scissor.row + static_cast<int>(at.pixel / width);
  Failure failure{vector.faces[at.face], {1, 1, {face.found.ids[at.pixel]}}, face.expected.ids[at.pixel], {}};
  failure.face.face.scissor = {column, row, 1, 1};
  failure.kind = errorAt(vector.list, failure.face, column, row, failure.found.ids[0]).kind;
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

ErrorPixel errorOf(const Failure& failure, const raster::DrawList& list) {
  const raster::Scissor& pixel = failure.face.face.scissor;
  return errorAt(list, failure.face, pixel.column, pixel.row, failure.found.ids[0]);
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

MinimalFailure minimize(const TestVector& vector, const Verdict& verdict, const DeviceProfile& profile) {
  assert(hasErrors(verdict));
  constexpr std::size_t sampled = 64, attempts = 8;
  std::vector<Failure> failures = sampleOfFailures(vector, verdict, sampled);
  const ErrorKind kind = mostFrequentKind(failures);
  std::erase_if(failures, [=](const Failure& failure) { return failure.kind != kind; });
  failures.resize(std::min(failures.size(), attempts));

  const DrawnTriangles all = drawnTriangles(vector.list);
  const Failure* best = nullptr;
  DrawnTriangles fewest;
  for (const Failure& failure : failures) {
    const auto fails = [&](std::span<const DrawnTriangle> kept) {
      return stillFails(failure, withUsedVertices(withTriangles(vector.list, kept)), profile);
    };
    const DrawnTriangles kept = fewestTriangles(all, fails);
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
