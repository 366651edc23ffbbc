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
          withRule("top-right", owns(-1, 1)), withRule("every edge", [](const raster::SnappedPoint&) { return true; })};
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

/// Coverage and depth per sample, colour once at the centre, which is the default of OpenGL and Vulkan. The resolve
/// averages colours per channel; for integer formats it takes the first sample.
std::vector<Variant> multisamplings(const TestVector& vector) {
  std::vector<Variant> variants;
  for (const int count : {2, 4, 8}) {
    StagedDevice device;
    device.samples = standardSamples(count);
    for (raster::SnappedPoint& sample : device.samples) sample = {16 * sample.x, 16 * sample.y};
    const std::string name = std::to_string(count) + " samples, ";
    variants.push_back({name + "the first", device});
    const std::vector<Channel> channels = colourChannelsOf(vector.list.format);
    device.resolve = [=](std::span<const ItemId> samples) {
      return idOf(channels, [&](const Channel& channel) {
        double sum = 0;
        for (const ItemId sample : samples) sum += channel.of(sample);
        return sum / static_cast<double>(samples.size());
      });
    };
    variants.push_back({name + "averaged", device, channels});
  }
  return variants;
}

// --- depth ---

/// 1 - n/w in 16 bits.
std::vector<Variant> sixteenBits() {
  std::vector<Variant> variants;
  for (const double rounding : {0.5, 0.0}) {
    const auto depth = [=](double inverseW, double nearDistance) {
      return std::floor((1 - nearDistance * inverseW) * 0xffff + rounding);
    };
    variants.push_back({rounding > 0 ? "rounded to nearest" : "truncated", withStage(&StagedDevice::depth, depth)});
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
  const auto turnedInMirroredViews = [](Facing side, const raster::Face& view) {
    return raster::determinant(view) < 0 ? otherSide(side) : side;
  };
  const auto culled = [](Facing side) {
    return withFacing([=](Facing facing) { return facing == side ? Facing::Culled : facing; });
  };
  return {{"triangles missing",
           "draw both facings: look at culling, the depth clear, blending onto the background",
           {{"all", withFacing([](Facing) { return Facing::Culled; })},
            {"those that face away", culled(Facing::Back)},
            {"those that face the eye", culled(Facing::Front)}}},
          {"front and back exchanged",
           "a mirrored view, det(X, Y, W) < 0, reverses windings: look at the front face",
           {{"", withFacing(otherSide)},
            {"in mirrored views", withStage(&StagedDevice::facing, turnedInMirroredViews)},
            {"all taken as fronts", withFacing([](Facing) { return Facing::Front; })},
            {"all taken as backs", withFacing([](Facing) { return Facing::Back; })}}},
          {"wrong fill rule",
           "a sample on an edge belongs to the triangle whose top or left edge it is; rows are those in memory",
           fillRules()},
          {"sample at the pixel corner", "sample i is at i + 1/2: look for half a pixel in projection or viewport",
           cornerSamples()},
          {"multisampling", "averages of item IDs are meaningless: ask for a target of one sample per pixel",
           multisamplings(vector)},
          {"16-bit depth", "ask for a depth format of 32-bit floats, or 24 bits at least", sixteenBits()},
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
