/// The lit scene for a page: triangles, texture coordinates and textures in base64, for three.js. Its size is bounded,
/// and the model says what it leaves out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The largest model. With these values a page has at most about 55 MB.
struct ModelLimits {
  std::size_t triangles = std::size_t{1} << 19;  ///< above it the smallest triangles are left out
  std::size_t texels = std::size_t{1} << 22;     ///< of all textures; above it each one is shrunk
};

/// A lit scene (radiosity/textures/lit_scene.h).
struct ShownScene {
  const radiosity::Scene& scene;
  const std::vector<radiosity::CodedImage>& textures;  ///< the reflectance maps of the materials
  const std::vector<std::uint32_t>& surfaceOf;         ///< one per surface: the number by which the page knows it
};

/// The model of a lit scene. The object has:
///
///     origin, extent   a position is (p - origin) / extent
///     parts            runs of triangles: {texture, triangles}; texture is null for corner colours
///     positions        binary32, three per corner
///     coordinates      16-bit fractions of 1, two per corner
///     colours          8-bit sRGB codes, three per corner, only for the part without texture
///     surfaces         32-bit numbers, one per triangle: the entries of `surfaceOf`
///     textures         PNG files, row 0 at the top
///     left_out         triangles, and the number by which the sides of textures are divided
nlohmann::ordered_json roomModel(const ShownScene& shown, const ModelLimits& limits = {});

/// The image with sides divided by `divisor` and rounded down, at least 1 texel. Each texel is the mean of the part of
/// the image that it covers, in linear light.
radiosity::Image shrunk(const radiosity::Image& image, int divisor);

}  // namespace hemitex::cli
