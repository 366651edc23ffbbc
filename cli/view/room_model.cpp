#include "cli/view/room_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

#include "cli/common/json.h"
#include "cli/report/html_page.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
using radiosity::CodedImage;
using radiosity::Image;

/// A triangle of the scene, and the image that it shows.
struct ShownTriangle {
  const radiosity::Triangle* triangle;
  std::uint32_t surface;
  std::optional<int> texture;  ///< none: corner colours
};

/// All triangles: textured ones by texture, then the others; otherwise in the order of the scene.
std::vector<ShownTriangle> trianglesByTexture(const radiosity::Scene& lit, std::size_t textures) {
  std::vector<ShownTriangle> triangles;
  for (std::uint32_t s = 0; s < lit.surfaces.size(); ++s) {
    const radiosity::Surface& surface = lit.surfaces[s];
    const auto& texture = lit.materials[static_cast<std::size_t>(surface.material)].reflectanceMap;
    for (const radiosity::Triangle& triangle : surface.triangles) triangles.push_back({&triangle, s, texture});
  }
  const auto key = [&](const ShownTriangle& shown) {
    return shown.texture ? static_cast<std::size_t>(*shown.texture) : textures;
  };
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](const ShownTriangle& a, const ShownTriangle& b) { return key(a) < key(b); });
  return triangles;
}

/// Removes the smallest triangles above a number; of equal ones the last. Returns how many it removed.
std::size_t keepLargest(std::vector<ShownTriangle>& triangles, std::size_t limit) {
  if (triangles.size() <= limit) return 0;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < triangles.size(); ++t) order.emplace_back(-radiosity::area(*triangles[t].triangle), t);
  std::sort(order.begin(), order.end());
  order.resize(limit);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<ShownTriangle> kept;
  for (const auto& [area, t] : order) kept.push_back(triangles[t]);
  const std::size_t removed = triangles.size() - kept.size();
  triangles = std::move(kept);
  return removed;
}

/// Appends the bytes of a number, lowest first.
template <typename Unsigned>
void append(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

void append(std::string& bytes, double value) {
  append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

/// A coordinate in [0, 1] as a fraction of 65535.
std::uint16_t fraction(double coordinate) {
  return static_cast<std::uint16_t>(std::nearbyint(std::clamp(coordinate, 0.0, 1.0) * 65535));
}

/// The number by which the sides of all textures are divided so that their texels are within the limit.
int divisorFor(const std::vector<CodedImage>& images, std::size_t limit) {
  const auto texels = [&](int divisor) {
    std::size_t sum = 0;
    for (const CodedImage& image : images)
      sum += static_cast<std::size_t>(std::max(1, image.width / divisor)) *
             static_cast<std::size_t>(std::max(1, image.height / divisor));
    return sum;
  };
  int divisor = 1;
  while (texels(divisor) > limit && texels(divisor) > images.size()) ++divisor;
  return divisor;
}

/// Rows of an image, each shrunk to `width` texels.
Image narrowed(const Image& image, int width) {
  Image result{width, image.height, {}};
  const double step = static_cast<double>(image.width) / width;
  for (int row = 0; row < image.height; ++row) {
    const auto start = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width);
    for (int column = 0; column < width; ++column) {
      const double begin = column * step, end = column + 1 == width ? image.width : (column + 1) * step;
      glm::dvec3 sum(0);
      for (int c = static_cast<int>(begin); c < end; ++c)
        sum += image.pixels[start + static_cast<std::size_t>(c)] *
               (std::min(end, c + 1.0) - std::max(begin, static_cast<double>(c)));
      result.pixels.push_back(sum / (end - begin));
    }
  }
  return result;
}

Image transposed(const Image& image) {
  Image result{image.height, image.width, {}};
  for (int column = 0; column < image.width; ++column)
    for (int row = 0; row < image.height; ++row)
      result.pixels.push_back(image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                           static_cast<std::size_t>(column)]);
  return result;
}

std::string pngLetters(const CodedImage& image, int divisor) {
  const CodedImage shown = divisor == 1 ? image : radiosity::encodeSrgb(shrunk(radiosity::decodeSrgb(image), divisor));
  const std::vector<unsigned char> bytes = radiosity::encodePng(shown, "texture");
  return base64({bytes.begin(), bytes.end()});
}

}  // namespace

Image shrunk(const Image& image, int divisor) {
  if (divisor == 1) return image;
  const Image narrow = narrowed(image, std::max(1, image.width / divisor));
  return transposed(narrowed(transposed(narrow), std::max(1, image.height / divisor)));
}

ordered_json roomModel(const ShownScene& scene, const ModelLimits& limits) {
  const auto& [lit, textures, surfaceOf] = scene;
  std::vector<ShownTriangle> triangles = trianglesByTexture(lit, textures.size());
  const std::size_t leftOut = keepLargest(triangles, limits.triangles);
  const double extent = lit.extent > 0 ? lit.extent : 1;
  std::string positions, coordinates, colours, surfaces;
  ordered_json parts = ordered_json::array();
  const std::optional<int>* part = nullptr;
  for (const ShownTriangle& shown : triangles) {
    if (part == nullptr || *part != shown.texture)
      parts.push_back({{"texture", shown.texture ? ordered_json(*shown.texture) : ordered_json()}, {"triangles", 0}});
    part = &shown.texture;
    parts.back()["triangles"] = parts.back()["triangles"].get<std::size_t>() + 1;
    append(surfaces, surfaceOf[shown.surface]);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 position = (shown.triangle->position[k] - lit.origin) / extent;
      for (int axis = 0; axis < 3; ++axis) append(positions, position[axis]);
      for (int axis = 0; axis < 2; ++axis) append(coordinates, fraction(shown.triangle->texcoord[k][axis]));
      if (shown.texture) continue;
      const glm::dvec3 colour = shown.triangle->cornerColor ? (*shown.triangle->cornerColor)[k] : glm::dvec3(0.5);
      for (int band = 0; band < 3; ++band)
        append(colours, static_cast<std::uint8_t>(std::nearbyint(255 * std::clamp(colour[band], 0.0, 1.0))));
    }
  }
  const int divisor = divisorFor(textures, limits.texels);
  return {{"origin", toJson(lit.origin)},
          {"extent", extent},
          {"parts", parts},
          {"positions", base64(positions)},
          {"coordinates", base64(coordinates)},
          {"colours", base64(colours)},
          {"surfaces", base64(surfaces)},
          {"textures", listOf(textures, [&](const CodedImage& image) { return pngLetters(image, divisor); })},
          {"left_out", {{"triangles", leftOut}, {"texture_divisor", divisor}}}};
}

}  // namespace hemitex::cli
