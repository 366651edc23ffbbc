/// Allowed deviations of a real device from the raster rules (raster rules, 8). A graphics API or a datasheet states
/// each bound; the verdict (verdict.h) takes all of them as worst cases.
#pragma once

#include <filesystem>
#include <string>

namespace hemitex::reference {

enum class SnapRounding {
  Nearest,   ///< to the nearest sub-pixel, ties either way
  Truncate,  ///< down to the next sub-pixel
};

enum class EdgeRule {
  TopLeft,  ///< a sample on an edge belongs to the triangle whose top or left edge it is
  Any,      ///< a sample on an edge may belong to any triangle of it, or to none
};

enum class DepthFormat { Float32, Unorm24, Unorm16 };

/// The default is a device of the Vulkan and Direct3D class.
struct DeviceProfile {
  /// Number of roundings in the vertex stage, each 2^-24 of the sum of absolute values of its terms: 4 of the rules,
  /// and 4 of a device that multiplies by a 4x4 matrix, in any order, fused or not.
  double vertexError = 8;
  int subpixelBits = 8;  ///< 4 to 12
  SnapRounding snapRounding = SnapRounding::Nearest;
  EdgeRule edgeRule = EdgeRule::TopLeft;
  double texelPrecision = 1.0 / 256;  ///< error of a texture coordinate, in texels
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

/// Reads a JSON object with any of the keys `vertex_error`, `subpixel_bits`, `snap_rounding` ("nearest", "truncate"),
/// `edge_rule` ("top-left", "any"), `texel_precision`, `depth_format` ("float32", "unorm24", "unorm16"),
/// `depth_tolerance`, `loose_clipping`, `strict_depth`; an absent key keeps its default. Throws InputError for an
/// unknown key, a value of the wrong type or out of range, and a file that cannot be read.
DeviceProfile readProfile(const std::filesystem::path& file);

/// The same from the text of such a file.
DeviceProfile parseProfile(const std::string& text);

/// The profile as readProfile reads it, with all keys.
std::string toJson(const DeviceProfile& profile);

}  // namespace hemitex::reference
