/// Allowed deviations of a real device from the raster rules. A graphics API or a datasheet states
/// each bound; the verdict (verdict.h) takes all of them as worst cases.
///
/// A device that interpolates in binary32 evaluates u = (u/w) / (1/w). Each of the two is a sum whose terms are as
/// large as at the nearest vertex of the triangle: max|u_k| / min w_k and 1 / min w_k. A rounding changes such a term
/// by 2^-24 of its size. Relative to 1/w at the sample it then moves u by 2^-24 max|u_k| w / min w_k.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hemitex::reference {

enum class SnapRounding {
  Nearest,   ///< to the nearest sub-pixel, ties either way
  Truncate,  ///< down to the next sub-pixel
  None,      ///< vertices are not snapped, whatever the number of bits
};

enum class EdgeRule {
  TopLeft,  ///< a sample on an edge belongs to the triangle whose top or left edge it is
  Any,      ///< a sample on an edge may belong to any triangle of it, or to none
};

enum class DepthFormat { Float32, Unorm24, Unorm16 };

constexpr int maxSubpixelBits = 16;

/// The default is a device of the Vulkan and Direct3D class.
struct DeviceProfile {
  /// Number of roundings in the vertex stage, each 2^-24 of the sum of absolute values of its terms: 4 of the rules,
  /// and 4 of a device that multiplies by a 4x4 matrix, in any order, fused or not.
  double vertexError = 8;
  int subpixelBits = 8;  ///< 4 to maxSubpixelBits
  SnapRounding snapRounding = SnapRounding::Nearest;
  EdgeRule edgeRule = EdgeRule::TopLeft;
  double texelPrecision = 1.0 / 256;  ///< error of a texture coordinate, in texels
  /// Number of roundings in the interpolation of a texture coordinate, each as above. Their error adds to
  /// texelPrecision.
  double interpolationError = 0;
  DepthFormat depthFormat = DepthFormat::Float32;
  double depthTolerance = 4;  ///< error of a stored depth, in units in the last place of 1
  /// Whether a device may clip triangles at other planes, or in binary32.
  bool looseClipping = true;
  /// Whether the first of two triangles with the same corners in the same order must stay. Any device computes equal
  /// depths for them; other equal depths may be rounded differently.
  bool strictDepth = false;

  bool operator==(const DeviceProfile&) const = default;
};

/// The error of a stored depth 1 - n/w, which ranges from 0 to 1.
double depthError(const DeviceProfile& profile);

/// The error of a texture coordinate in texels, at a sample of depth w = 1/inverseDepth. `size` is the side of the
/// index map, `largest` the maximum of |u_k|, and `nearestDepth` the minimum of w_k.
double texelError(const DeviceProfile& profile, double size, double largest, double nearestDepth, double inverseDepth);

/// Reads a JSON object with any of the keys `version`, `vertex_error`, `subpixel_bits`, `snap_rounding` ("nearest",
/// "truncate", "none"), `edge_rule` ("top-left", "any"), `texel_precision`, `interpolation_error`, `depth_format`
/// ("float32", "unorm24", "unorm16"), `depth_tolerance`, `loose_clipping`, `strict_depth`; an absent key keeps its
/// default. Version 1, which files without `version` have, knows no `interpolation_error`. Throws InputError for an
/// unknown key, a value of the wrong type or out of range, and a file that cannot be read.
DeviceProfile readProfile(const std::filesystem::path& file);

/// The same from the text of such a file.
DeviceProfile parseProfile(const std::string& text);

/// The profile as readProfile reads it, in version 2 with all keys.
nlohmann::ordered_json toJson(const DeviceProfile& profile);

}  // namespace hemitex::reference
