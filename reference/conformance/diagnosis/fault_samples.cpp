/// Faults of facing, coverage and depth.
#include <cmath>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

StagedDevice withFacing(const std::function<Facing(Facing)>& facing) {
  return withStage(&StagedDevice::facing, [=](Facing side, const raster::Face&) { return facing(side); });
}

// --- coverage ---

Variant withRule(const std::string& name, const std::function<bool(const raster::SnappedPoint&)>& ownsSamples) {
  return {name, withStage(&StagedDevice::ownsSamples, ownsSamples)};
}

std::vector<Variant> fillRules() {
  const auto owns = [](int left, int top) {
    return [=](const raster::SnappedPoint& d) { return d.y != 0 ? left * d.y < 0 : top * d.x > 0; };
  };
  return {withRule("bottom-left", owns(1, -1)), withRule("bottom-right", owns(-1, -1)),
          withRule("top-right", owns(-1, 1)), withRule("every edge", [](const raster::SnappedPoint&) { return true; }),
          withRule("no edge", [](const raster::SnappedPoint&) { return false; })};
}

std::vector<Variant> cornerSamples() {
  std::vector<Variant> variants;
  for (const char* name : {"left top", "right top", "left bottom", "right bottom"}) {
    const auto k = static_cast<std::int64_t>(variants.size());
    StagedDevice device;
    device.shadingSample = {256 * (k % 2), 256 * (k / 2)};
    device.samples = {device.shadingSample};
    variants.push_back({name, device});
  }
  return variants;
}

/// The standard sample locations of Vulkan and Direct3D, in sixteenths of a pixel.
std::vector<raster::SnappedPoint> standardSamples(int count) {
  switch (count) {
    case 2:
      return {{12, 12}, {4, 4}};
    case 4:
      return {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
    default:
      return {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
  }
}

/// Averages the samples per channel.
Variant averaged(const std::string& name, StagedDevice device, const raster::IdFormat& format) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  device.resolve = [=](std::span<const ItemId> samples) {
    return idOf(channels, [&](const Channel& channel) {
      double sum = 0;
      for (const ItemId sample : samples) sum += channel.of(sample);
      return sum / static_cast<double>(samples.size());
    });
  };
  return {name, device, channels};
}

/// Coverage and depth per sample, colour once at the centre, which is the default of OpenGL and Vulkan. The resolve
/// averages colours per channel; for integer formats it takes the first sample. Rows of the standard locations count
/// upwards on some devices.
std::vector<Variant> multisamplings(const TestVector& vector) {
  std::vector<Variant> variants;
  for (const int count : {2, 4, 8})
    for (const bool isUpwards : {false, true}) {
      StagedDevice device;
      device.samples = standardSamples(count);
      for (raster::SnappedPoint& sample : device.samples)
        sample = {16 * sample.x, 16 * (isUpwards ? 16 - sample.y : sample.y)};
      const std::string name = std::to_string(count) + (isUpwards ? " samples upwards, " : " samples, ");
      variants.push_back({name + "the first", device});
      variants.push_back(averaged(name + "averaged", device, vector.list.format));
    }
  return variants;
}

/// Pictures of twice or four times the resolution, averaged.
std::vector<Variant> supersamplings(const raster::IdFormat& format) {
  std::vector<Variant> variants;
  for (const std::int64_t count : {2, 4}) {
    StagedDevice device;
    device.shadesSamples = true;
    device.samples.clear();
    for (std::int64_t k = 0; k < count * count; ++k)
      device.samples.push_back({(2 * (k % count) + 1) * 128 / count, (2 * (k / count) + 1) * 128 / count});
    const std::string side = std::to_string(count);
    variants.push_back(averaged(side + " x " + side + " pixels", device, format));
  }
  return variants;
}

/// Every pixel that a triangle touches, without those that it touches at their border only, or with them.
std::vector<Variant> conservativeRules() {
  return {{"", withStage(&StagedDevice::widening, std::int64_t{127})},
          {"borders included", withStage(&StagedDevice::widening, std::int64_t{128})}};
}

/// In clip space a mirrored view is one with rows upwards, which has a fault of its own (fault_assembly.cpp).
std::vector<Variant> exchangedSides(const raster::DrawList& list) {
  std::vector<Variant> variants{{"", withFacing(otherSide)},
                                {"all taken as fronts", withFacing([](Facing) { return Facing::Front; })},
                                {"all taken as backs", withFacing([](Facing) { return Facing::Back; })}};
  if (list.clipDepth == raster::ClipDepth::None) variants.push_back(turnedInMirroredViews("in mirrored views"));
  return variants;
}

// --- depth ---

std::vector<Variant> depthBiases() {
  std::vector<Variant> variants;
  for (const int factor : {1, 2, 4, -1, -2, -4})
    variants.push_back({"factor " + std::to_string(factor), withStage(&StagedDevice::depthBias, double(factor))});
  return variants;
}

/// 1 - n/w in 16 bits, cleared to the largest depth.
std::vector<Variant> sixteenBits(const raster::DrawList& list) {
  std::vector<Variant> variants;
  for (const double rounding : {0.5, 0.0}) {
    const auto depth = [=, clip = raster::depthRuleOf(list, {}), isScene = list.clipDepth == raster::ClipDepth::None](
                           double nearness, double nearDistance) {
      const double d = isScene ? 1 - nearDistance * nearness : clip.offset - clip.scale * nearness;
      return std::floor(d * 0xffff + rounding);
    };
    StagedDevice device = withStage(&StagedDevice::depth, depth);
    device.clearedDepth = list.depthTest >= raster::DepthTest::Farther ? 0 : 0xffff;
    variants.push_back({rounding > 0 ? "rounded to nearest" : "truncated", device});
  }
  return variants;
}

/// Depths n/w stay in the target.
StagedDevice withDepthKept() {
  StagedDevice device = withStage(&StagedDevice::keepsDepth, true);
  device.depth = [](double inverseW, double nearDistance) { return -nearDistance * inverseW; };
  return device;
}

}  // namespace

std::vector<Fault> sampleFaults(const TestVector& vector) {
  const auto culled = [](Facing side) {
    return withFacing([=](Facing facing) { return facing == side ? Facing::Culled : facing; });
  };
  return {{"triangles missing",
           "draw both facings: look at culling, the depth clear, blending onto the background",
           {{"all", withFacing([](Facing) { return Facing::Culled; })},
            {"those that face away", culled(Facing::Back)},
            {"those that face the eye", culled(Facing::Front)}}},
          {"front and back exchanged", "a mirrored view, det(X, Y, W) < 0, reverses windings: look at the front face",
           exchangedSides(vector.list)},
          {"wrong fill rule",
           "a sample on an edge belongs to the triangle whose top or left edge it is; rows are those in memory",
           fillRules()},
          {"conservative rasterization",
           "a triangle covers the samples at pixel centres: turn conservative rasterization off", conservativeRules()},
          {"sample at the pixel corner", "sample i is at i + 1/2: look for half a pixel in projection or viewport",
           cornerSamples()},
          {"multisampling", "averages of item IDs are meaningless: ask for a target of one sample per pixel",
           multisamplings(vector)},
          {"supersampling averaged", "averages of item IDs are meaningless: draw at the resolution of the face",
           supersamplings(vector.list.format)},
          {"16-bit depth", "ask for a depth format of 32-bit floats, or 24 bits at least", sixteenBits(vector.list)},
          {"depth bias", "turn polygon offset and depth bias off", depthBiases()},
          {"depth test off",
           "turn the depth test and depth writes on, and attach a depth buffer",
           {{"", withStage(&StagedDevice::passes, [](double, double) { return true; })}}},
          {"depth test reversed",
           "the nearer fragment wins: look at the comparison, the depth range and the depth clear",
           {{"", withStage(&StagedDevice::passes, [](double depth, double stored) { return depth > stored; })}}},
          {"equal depths pass the depth test",
           "at equal depths the triangle drawn first stays: compare with less or greater, without or equal",
           {{"", withStage(&StagedDevice::passes,
                           [](double depth, double stored) { return depth <= stored + 0x1p-40 * std::abs(stored); })}}},
          {"depth not cleared between faces",
           "clear the depth of the whole target before each face",
           {{"", withDepthKept()}}}};
}

}  // namespace hemitex::reference
