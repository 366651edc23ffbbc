#include "reference/conformance/verdict/device_profile.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"
#include "reference/conformance/vectors/enum_names.h"

namespace hemitex::reference {
namespace {

using Json = nlohmann::ordered_json;
using raster::InputError;

constexpr std::array<Named<SnapRounding>, 3> snapRoundingNames{
    {{SnapRounding::Nearest, "nearest"}, {SnapRounding::Truncate, "truncate"}, {SnapRounding::None, "none"}}};
constexpr std::array<Named<EdgeRule>, 2> edgeRuleNames{{{EdgeRule::TopLeft, "top-left"}, {EdgeRule::Any, "any"}}};
constexpr std::array<Named<DepthFormat>, 3> depthFormatNames{
    {{DepthFormat::Float32, "float32"}, {DepthFormat::Unorm24, "unorm24"}, {DepthFormat::Unorm16, "unorm16"}}};

template <typename Value, std::size_t count>
void readChoice(const Json& value, const std::string& key, const std::array<Named<Value>, count>& names,
                Value& target) {
  target = valueOf(names, value.is_string() ? value.get<std::string>() : shortText(value), key);
}

void readBound(const Json& value, const std::string& key, double& target) {
  if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0)
    throw InputError("\"" + key + "\" is " + shortText(value), "use a number from 0 up");
  target = value.get<double>();
}

void readSubpixelBits(const Json& value, const std::string& key, int& target) {
  if (!value.is_number_integer() || value < 4 || value > maxSubpixelBits)
    throw InputError("\"" + key + "\" is " + shortText(value), "use a whole number from 4 to 16");
  target = value.get<int>();
}

void readFlag(const Json& value, const std::string& key, bool& target) {
  if (!value.is_boolean()) throw InputError("\"" + key + "\" is " + shortText(value), "use true or false");
  target = value.get<bool>();
}

void readField(const Json& value, const std::string& key, DeviceProfile& profile) {
  if (key == "vertex_error") return readBound(value, key, profile.vertexError);
  if (key == "subpixel_bits") return readSubpixelBits(value, key, profile.subpixelBits);
  if (key == "snap_rounding") return readChoice(value, key, snapRoundingNames, profile.snapRounding);
  if (key == "edge_rule") return readChoice(value, key, edgeRuleNames, profile.edgeRule);
  if (key == "texel_precision") return readBound(value, key, profile.texelPrecision);
  if (key == "interpolation_error") return readBound(value, key, profile.interpolationError);
  if (key == "depth_format") return readChoice(value, key, depthFormatNames, profile.depthFormat);
  if (key == "depth_tolerance") return readBound(value, key, profile.depthTolerance);
  if (key == "loose_clipping") return readFlag(value, key, profile.looseClipping);
  if (key == "strict_depth") return readFlag(value, key, profile.strictDepth);
  throw InputError("\"" + key + "\" is not a key of a device profile");
}

void checkVersion(const Json& json) {
  const Json version = json.value("version", Json(1));
  if (version != 1 && version != 2)
    throw InputError("\"version\" is " + shortText(version), "use version 2, or 1 of earlier programs");
  if (version == 1 && json.contains("interpolation_error"))
    throw InputError("\"interpolation_error\" is not a key of version 1", "add \"version\": 2");
}

}  // namespace

double texelError(const DeviceProfile& profile, double size, double largest, double nearestDepth, double inverseDepth) {
  const double rounding = 0x1p-24 * size * largest / (nearestDepth * inverseDepth);
  return profile.texelPrecision + profile.interpolationError * rounding;
}

double depthError(const DeviceProfile& profile) {
  switch (profile.depthFormat) {
    case DepthFormat::Float32:
      return profile.depthTolerance * 0x1p-23;
    case DepthFormat::Unorm24:
      return profile.depthTolerance / 0xffffff;
    case DepthFormat::Unorm16:
      return profile.depthTolerance / 0xffff;
  }
  return 0;
}

Json toJson(const DeviceProfile& profile) {
  return {{"version", 2},
          {"vertex_error", profile.vertexError},
          {"subpixel_bits", profile.subpixelBits},
          {"snap_rounding", nameOf(snapRoundingNames, profile.snapRounding)},
          {"edge_rule", nameOf(edgeRuleNames, profile.edgeRule)},
          {"texel_precision", profile.texelPrecision},
          {"interpolation_error", profile.interpolationError},
          {"depth_format", nameOf(depthFormatNames, profile.depthFormat)},
          {"depth_tolerance", profile.depthTolerance},
          {"loose_clipping", profile.looseClipping},
          {"strict_depth", profile.strictDepth}};
}

DeviceProfile parseProfile(const std::string& text) {
  const Json json = parseJson<Json>(text);
  if (!json.is_object()) throw InputError("a device profile is a JSON object");
  DeviceProfile profile;
  checkVersion(json);
  for (const auto& [key, value] : json.items())
    if (key != "version") readField(value, key, profile);
  return profile;
}

DeviceProfile readProfile(const std::filesystem::path& file) {
  const std::string text = raster::readFile(file);
  try {
    return parseProfile(text);
  } catch (const InputError& error) {
    throw InputError(file.string(), 0, error.what());
  }
}

}  // namespace hemitex::reference
