/// Faults of draws, and of passes that change the item IDs of fragments or pixels.
#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::Draw;
using raster::DrawList;
using raster::ItemId;
using raster::SnappedTriangle;

Variant withUpload(const std::string& name, const std::function<void(DrawList&)>& upload) {
  return {name, withStage(&StagedDevice::upload, upload)};
}

// --- which triangles are drawn ---

std::vector<Variant> missingDraws() {
  const auto withCounts = [](const std::string& name, std::uint32_t (*count)(std::uint32_t)) {
    return withUpload(name, [=](DrawList& list) {
      for (Draw& draw : list.draws) draw.count = count(draw.count);
    });
  };
  const auto without = [](const std::string& name, bool isLast) {
    return withUpload(name, [=](DrawList& list) {
      if (!list.draws.empty()) (isLast ? list.draws.back() : list.draws.front()).count = 0;
    });
  };
  return {
      without("the first draw", false), without("the last draw", true),
      withCounts("the last triangle of each draw", [](std::uint32_t count) { return count < 3 ? 0 : count - 3; }),
      withCounts("all but the first third of each draw", [](std::uint32_t count) { return (count / 3 + 2) / 3 * 3; })};
}

std::vector<Variant> smallTriangles() {
  constexpr std::int64_t pixel = 2 * 256 * 256;  // in the units of SnappedTriangle::area
  const auto isLarge = [](std::int64_t least) {
    return [=](const SnappedTriangle& triangle) { return std::abs(triangle.area) >= least; };
  };
  const auto isWide = [](const SnappedTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    return right - left >= 256 && bottom - top >= 256;
  };
  return {{"an area below 1/2 pixel", withStage(&StagedDevice::keeps, isLarge(pixel / 2))},
          {"an area below 1 pixel", withStage(&StagedDevice::keeps, isLarge(pixel))},
          {"an area below 4 pixels", withStage(&StagedDevice::keeps, isLarge(4 * pixel))},
          {"narrower or lower than a pixel", withStage(&StagedDevice::keeps, isWide)}};
}

// --- what draws use ---

/// Which of `count` draws gives its value to draw k.
struct Source {
  const char* name;
  std::size_t (*of)(std::size_t k, std::size_t count);
};

constexpr std::array<Source, 4> wrongSources{
    {{"the first draw", [](std::size_t, std::size_t) { return std::size_t{0}; }},
     {"the last draw", [](std::size_t, std::size_t count) { return count - 1; }},
     {"the draw before", [](std::size_t k, std::size_t) { return k == 0 ? 0 : k - 1; }},
     {"the next draw", [](std::size_t k, std::size_t count) { return std::min(k + 1, count - 1); }}}};

/// Of the draws that satisfy `takesPart`, each takes the value of another one.
template <typename Value, typename TakesPart>
std::vector<Variant> valuesOfOthers(Value Draw::*value, const TakesPart& takesPart) {
  std::vector<Variant> variants;
  for (const Source& source : wrongSources)
    variants.push_back(withUpload(source.name, [=](DrawList& list) {
      std::vector<Draw*> draws;
      for (Draw& draw : list.draws)
        if (takesPart(draw)) draws.push_back(&draw);
      std::vector<Value> values;
      for (std::size_t k = 0; k < draws.size(); ++k) values.push_back(draws[source.of(k, draws.size())]->*value);
      for (std::size_t k = 0; k < draws.size(); ++k) draws[k]->*value = values[k];
    }));
  return variants;
}

// --- fragments ---

StagedDevice withLines() {
  StagedDevice device;
  device.drawsLines = true;
  return device;
}

std::vector<Variant> coarseShadings() {
  return {{"2 x 2 pixels", withStage(&StagedDevice::shadingBlock, 2)},
          {"4 x 4 pixels", withStage(&StagedDevice::shadingBlock, 4)}};
}

/// The visible part of a colour in fog at x, a distance in units of its density; and the inverse.
struct FogCurve {
  const char* name;
  double (*visible)(double);
  double (*inverse)(double);
};

constexpr std::array<FogCurve, 3> fogCurves{
    {{"exponential", [](double x) { return std::exp(-x); }, [](double part) { return -std::log(part); }},
     {"exponential of the square", [](double x) { return std::exp(-x * x); },
      [](double part) { return std::sqrt(-std::log(part)); }},
     {"linear", [](double x) { return std::clamp(1 - x, 0.0, 1.0); }, [](double part) { return 1 - part; }}}};

/// x = density (w - start).
struct FogRange {
  double density, start;
};

/// A fog of one brightness, from 0 to 1, on all channels but alpha.
Variant fogVariant(const raster::IdFormat& format, const FogCurve& curve, double brightness, const FogRange& range) {
  const std::vector<Channel> channels = colourChannelsOf(format);
  const auto fade = [=, visible = curve.visible](ItemId id, double w) {
    const double part = visible(range.density * std::max(w - range.start, 0.0));
    return idOf(channels, [&](const Channel& channel) {
      const bool isAlpha = channels.size() == 4 && channel.shift == channels[3].shift;
      const double value = channel.of(id), fog = brightness * static_cast<double>(channel.largest());
      return isAlpha ? value : part * value + (1 - part) * fog;
    });
  };
  return {std::string(curve.name) + (brightness == 0   ? ", black"
                                     : brightness == 1 ? ", white"
                                                       : ", grey"),
          withStage(&StagedDevice::fade, fade), channels};
}

/// The distance w of each pixel's triangle, zero for the background.
std::vector<double> distancesOf(const PlacedVector& placed) {
  const StagedDevice device =
      withStage(&StagedDevice::fade, [](ItemId, double w) { return std::bit_cast<ItemId>(static_cast<float>(w)); });
  const ItemId background = raster::backgroundId(placed.list.format);
  std::vector<double> distances;
  drawOn(device, placed, [&](const raster::ItemBuffer& part) {
    for (const ItemId bits : part.ids)
      distances.push_back(bits == background ? 0.0 : static_cast<double>(std::bit_cast<float>(bits)));
    return true;
  });
  return distances;
}

/// A distance and the x of a curve there.
struct FogSample {
  double w, x;
};

/// The pixels in which a fog of one brightness leaves between 10 and 90 % of a channel, which changes by 16 steps at
/// least; nearest first.
std::vector<FogSample> fogSamples(const PlacedVector& placed, std::span<const ItemId> found, const FogCurve& curve,
                                  double brightness) {
  const std::vector<double> distances = distancesOf(placed);
  std::vector<FogSample> samples;
  std::size_t pixel = 0;
  for (const raster::ItemBuffer& buffer : placed.buffers)
    for (const ItemId id : buffer.ids) {
      const std::size_t at = pixel++;
      if (distances[at] <= 0) continue;
      for (const Channel& channel : colourChannelsOf(placed.list.format)) {
        const double fog = brightness * static_cast<double>(channel.largest()), clear = channel.of(id) - fog;
        const double part = (channel.of(found[at]) - fog) / clear;
        if (std::abs(clear) >= 16 && part > 0.1 && part < 0.9) samples.push_back({distances[at], curve.inverse(part)});
      }
    }
  std::sort(samples.begin(), samples.end(), [](const FogSample& a, const FogSample& b) { return a.w < b.w; });
  return samples;
}

/// Linear fog may start anywhere, so that it takes two samples.
std::vector<FogRange> fogRanges(const std::vector<FogSample>& samples, bool isLinear) {
  std::vector<FogRange> ranges;
  if (samples.empty()) return ranges;
  const std::size_t count = samples.size();  // the outermost ones may be edges that devices place differently
  const FogSample &near = samples[count / 8], &far = samples[count - 1 - count / 8], &middle = samples[count / 2];
  ranges.push_back({middle.x / middle.w, 0});
  if (isLinear && far.x > near.x && far.w > near.w) {
    const double density = (far.x - near.x) / (far.w - near.w);
    ranges.push_back({density, near.w - near.x / density});
  }
  return ranges;
}

// --- item IDs and pixels ---

std::vector<Variant> plusOne(const raster::IdFormat& format) {
  const ItemId background = raster::backgroundId(format);
  return {{"all pixels", withIds([=](ItemId id) { return (id + 1) & background; })},
          {"all but the background", withIds([=](ItemId id) { return id == background ? id : id + 1; })}};
}

std::vector<Variant> signedIds(const raster::IdFormat& format) {
  if (raster::idBits(format) < 32) return {};
  constexpr ItemId largest = 0x7fffffff;
  return {{"clamped to 2^31 - 1", withIds([=](ItemId id) { return std::min(id, largest); })},
          {"negative ones as 0", withIds([](ItemId id) { return id > largest ? 0 : id; })},
          {"without the sign", withIds([](ItemId id) { return id & largest; })}};
}

/// Square tiles that follow each other in memory, read as rows. Pictures of other sizes stay.
std::vector<Variant> tiledPictures() {
  std::vector<Variant> variants;
  for (const int side : {2, 4, 8, 16}) {
    const auto asRows = [=](const raster::Face&, raster::ItemBuffer& buffer) {
      if (buffer.width % side != 0 || buffer.height % side != 0) return;
      const std::vector<ItemId> rows = buffer.ids;
      for (int k = 0; k < buffer.width * buffer.height; ++k) {
        const int tile = k / (side * side), across = buffer.width / side, inTile = k % (side * side);
        const int column = tile % across * side + inTile % side, row = tile / across * side + inTile / side;
        buffer.ids[static_cast<std::size_t>(k)] = rows[static_cast<std::size_t>(row * buffer.width + column)];
      }
    };
    variants.push_back({std::to_string(side) + " x " + std::to_string(side) + " pixels", withReadBack(asRows)});
  }
  return variants;
}

}  // namespace

std::vector<Fault> drawFaults(const TestVector& vector) {
  const raster::IdFormat& format = vector.list.format;
  const auto zeroAsNothing = [background = raster::backgroundId(format)](ItemId id) {
    return id == 0 ? background : id;
  };
  return {
      {"draws or triangles not drawn", "draw all runs, with the number of indices, three per triangle", missingDraws()},
      {"small triangles not drawn",
       "a triangle covers a sample whatever its size: leave out the culling of small triangles", smallTriangles()},
      {"offset of another draw",
       "set the offset before each draw: look for a uniform that changes after the draw is recorded",
       valuesOfOthers(&Draw::offset, [](const Draw&) { return true; })},
      {"index map of another draw", "bind the index map of each draw before it is drawn",
       valuesOfOthers(&Draw::indexMap, [](const Draw& draw) { return draw.indexMap.has_value(); })},
      {"polygon mode of lines", "fill triangles: look for a wireframe mode that is left on", {{"", withLines()}}},
      {"coarse shading", "shade each pixel: set the shading rate to 1 x 1", coarseShadings()},
      {"item IDs one too large",
       "0 is an item ID, and the background is all ones: undo an ID + 1 that was to mark the background",
       plusOne(format)},
      {"item ID 0 taken for nothing",
       "0 is an item ID, and the background is all ones",
       {{"", withIds(zeroAsNothing)}}},
      {"item IDs through signed integers", "item IDs are unsigned: ask for unsigned formats, and read them as such",
       signedIds(format)},
      {"tiled memory read as rows", "copy the picture to linear memory before it is read", tiledPictures()}};
}

Fault fogLike(const PlacedVector& placed, std::span<const ItemId> found) {
  Fault fault{"fog", "draw item IDs without fog, and let no pass change their target", {}};
  for (const FogCurve& curve : fogCurves)
    for (const double brightness : {0.0, 0.5, 1.0}) {
      const std::vector<FogSample> samples = fogSamples(placed, found, curve, brightness);
      for (const FogRange& range : fogRanges(samples, &curve == &fogCurves.back()))
        fault.variants.push_back(fogVariant(placed.list.format, curve, brightness, range));
    }
  return fault;
}

}  // namespace hemitex::reference
