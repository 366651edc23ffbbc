#include "raster/interface/face.h"

#include <cmath>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

bool isFinite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isInside(const Scissor& scissor, const Viewport& viewport) {
  return scissor.column >= 0 && scissor.row >= 0 && scissor.width > 0 && scissor.height > 0 &&
         scissor.width <= viewport.columns - scissor.column && scissor.height <= viewport.rows - scissor.row;
}

bool isSide(int pixels) { return pixels >= 1 && pixels <= maxSide; }

}  // namespace

double determinant(const Face& face) {
  const glm::dvec3 x(face.x), y(face.y), w(face.w);
  return glm::dot(x, glm::cross(y, w));
}

void validate(const Face& face) {
  if (!isFinite(face.eye) || !isFinite(face.x) || !isFinite(face.y) || !isFinite(face.w))
    throw InputError("a face has an eye or a row that is not finite");
  if (const double det = determinant(face); det == 0 || !std::isfinite(det))
    throw InputError("a face's rows x, y, w do not span space (their determinant is zero or not finite)");
  if (!(face.nearDistance > 0) || !std::isfinite(face.nearDistance))
    throw InputError("a face's near distance is not a positive number");
  if (face.viewport && !(isSide(face.viewport->columns) && isSide(face.viewport->rows)))
    throw InputError("a face's viewport is too small or too large", "use 1 to 16384 columns and rows");
  if (!face.viewport && (face.resolution < 2 || face.resolution > 4096 || face.resolution % 2 != 0))
    throw InputError("a face's resolution is " + std::to_string(face.resolution), "use an even number from 2 to 4096");
  if (!isInside(face.scissor, viewportOf(face))) throw InputError("a face's scissor rectangle leaves its viewport");
}

bool isUsual(const Face& face) { return !face.viewport && face.sample == SamplePlace::Middle; }

void requireUsual(const Face& face) {
  if (!isUsual(face))
    throw InputError("this renderer draws square viewports with samples in the middle of pixels",
                     "use the plain renderer");
}

}  // namespace hemitex::raster
