/// Faults of lookups in index maps.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::IndexMap;
using raster::ItemId;

/// A lookup in one index map.
using MapFetch = std::function<ItemId(const IndexMap&, const Lookup&)>;

StagedDevice withFetch(const MapFetch& fetch) {
  return withStage(&StagedDevice::fetch, [=](const raster::DrawList& list, std::size_t map, const Lookup& lookup) {
    return fetch(list.indexMaps[map], lookup);
  });
}

// --- coordinates ---

glm::dvec2 withoutPerspective(const raster::SnappedTriangle& triangle, const raster::SnappedPoint& position) {
  const glm::dvec3 sum = weightedSum(triangle, weightsAt(triangle, position), [](double) { return 1.0; });
  return glm::dvec2(sum) / sum.z;
}

/// A column or row outside of the map repeats.
ItemId wrappedTexel(const IndexMap& map, const glm::dvec2& texel) {
  return texelAt(map, texel - sizeOf(map) * glm::floor(texel / sizeOf(map)));
}

/// The part behind the point of a coordinate just below 0 is rounded to 1, which is texel 0 again.
ItemId repeatedTexel(const IndexMap& map, const Lookup& lookup) {
  return wrappedTexel(map, glm::floor((lookup.at - glm::floor(lookup.at)) * sizeOf(map)));
}

/// Where rounding makes a coordinate of 0 smaller, it repeats, too.
ItemId repeatedTexelBelow(const IndexMap& map, const Lookup& lookup) {
  glm::dvec2 at = lookup.at;
  for (int axis = 0; axis < 2; ++axis)
    if (std::abs(at[axis]) < 0x1p-30) at[axis] = -0x1p-30;
  return nearestTexel(map, at - glm::floor(at));
}

/// Texture units round u N to 1/256 texel before it repeats.
ItemId repeatedTexelInFixedPoint(const IndexMap& map, const Lookup& lookup) {
  const glm::dvec2 size = sizeOf(map);
  glm::dvec2 texel;
  for (int axis = 0; axis < 2; ++axis)
    texel[axis] = std::floor(std::nearbyint(lookup.at[axis] * size[axis] * 256) / 256);
  return wrappedTexel(map, texel);
}

/// A coordinate within rounding of 0 or 1 may repeat on one device and not on another.
ItemId repeatedTexelAtBorders(const IndexMap& map, const Lookup& lookup) {
  const glm::dvec2 size = sizeOf(map);
  glm::dvec2 texel = glm::floor(lookup.at * size);
  for (int axis = 0; axis < 2; ++axis) {
    const double at = lookup.at[axis] * size[axis], rounding = 1.0 / 256 + 0x1p-18 * size[axis];
    if (std::abs(at) <= rounding) texel[axis] = -1;
    if (std::abs(at - size[axis]) <= rounding) texel[axis] = size[axis];
  }
  return wrappedTexel(map, texel);
}

/// Texels of a border around the map.
std::vector<Variant> borders(const raster::IdFormat& format) {
  const auto with = [](ItemId border) {
    return withFetch([=](const IndexMap& map, const Lookup& lookup) {
      const glm::dvec2 texel = glm::floor(lookup.at * sizeOf(map)), last = sizeOf(map) - 1.0;
      const bool isInside = texel.x >= 0 && texel.y >= 0 && texel.x <= last.x && texel.y <= last.y;
      return isInside ? texelAt(map, texel) : border;
    });
  };
  return {{"zeros", with(0)}, {"ones", with(raster::backgroundId(format))}};
}

/// Sizes that are powers of two: the map is scaled to them, or padded with zeros.
std::vector<Variant> powersOfTwo() {
  const auto sizeFor = [](int size, bool isLarger) {
    int power = 1;
    while (2 * power <= size) power *= 2;
    return isLarger && power < size ? 2 * power : power;
  };
  const auto resized = [=](const std::string& name, bool isLarger, bool isPadded) {
    const auto upload = [=](raster::DrawList& list) {
      for (IndexMap& map : list.indexMaps) {
        const IndexMap source = map;
        map = {sizeFor(source.width, isLarger), sizeFor(source.height, isLarger), {}};
        for (int row = 0; row < map.height; ++row)
          for (int column = 0; column < map.width; ++column) {
            const glm::dvec2 texel(column, row), scale = isPadded ? glm::dvec2(1) : sizeOf(source) / sizeOf(map);
            const bool isBeyond = isPadded && (column >= source.width || row >= source.height);
            map.ids.push_back(isBeyond ? 0 : texelAt(source, (texel + 0.5) * scale));
          }
      }
    };
    return Variant{name, withStage(&StagedDevice::upload, upload)};
  };
  return {resized("scaled down", false, false), resized("scaled up", true, false), resized("padded", true, true)};
}

ItemId mirroredTexel(const IndexMap& map, const Lookup& lookup) {
  const glm::dvec2 period = lookup.at - 2.0 * glm::floor(lookup.at / 2.0);
  return nearestTexel(map, glm::min(period, 2.0 - period));
}

std::vector<Variant> halfTexelShifts() {
  std::vector<Variant> variants;
  for (int k = 0; k < 9; ++k) {
    const glm::dvec2 shift(k % 3 - 1, k / 3 - 1);
    const auto text = [](double s) { return s < 0 ? std::string("-1/2") : s > 0 ? "+1/2" : "0"; };
    if (k == 4) continue;
    variants.push_back({text(shift.x) + ", " + text(shift.y), withFetch([=](const IndexMap& map, const Lookup& lookup) {
                          return nearestTexel(map, lookup.at + 0.5 * shift / sizeOf(map));
                        })});
  }
  return variants;
}

/// Coordinates of the unit square in fixed point with 8 fractional bits (16.8).
ItemId truncatedTexel(const IndexMap& map, const Lookup& lookup) {
  return nearestTexel(map, glm::floor(lookup.at * 256.0) / 256.0);
}

/// The nearest number of 11 significant bits (binary16); subnormal numbers and overflow included.
double throughBinary16(double x) {
  if (x == 0) return 0;
  const double unit = std::ldexp(1.0, std::max(std::ilogb(x), -14) - 10);
  const double rounded = std::nearbyint(x / unit) * unit;
  return std::abs(rounded) < 65520 ? rounded : std::copysign(HUGE_VAL, x);
}

glm::dvec2 throughBinary16(const glm::dvec2& at) { return {throughBinary16(at.x), throughBinary16(at.y)}; }

std::vector<Variant> halfFloats() {
  const auto atVertices = [](raster::DrawList& list) {
    for (glm::vec2& texcoord : list.texcoords) texcoord = glm::vec2(throughBinary16(glm::dvec2(texcoord)));
  };
  return {{"at vertices", withStage(&StagedDevice::upload, atVertices)},
          {"at pixels", withFetch([](const IndexMap& map, const Lookup& lookup) {
             return nearestTexel(map, throughBinary16(lookup.at));
           })},
          {"at pixels, and their products with the size of the map",
           withFetch([](const IndexMap& map, const Lookup& lookup) {
             return texelAt(map, throughBinary16(throughBinary16(lookup.at) * sizeOf(map)));
           })}};
}

/// Coordinates that are smaller by a few units in the last place of binary32.
std::vector<Variant> justBelow() {
  std::vector<Variant> variants;
  for (const int units : {1, 2, 4, 8})
    variants.push_back(
        {"by " + std::to_string(units) + " x 2^-24", withFetch([=](const IndexMap& map, const Lookup& l) {
           return nearestTexel(map, l.at - glm::abs(l.at) * (units * 0x1p-24));
         })});
  return variants;
}

/// u N and v M in binary32, at the vertices or at the pixel.
std::vector<Variant> roundedProducts() {
  const auto atVertices = [](const IndexMap& map, const Lookup& lookup) {
    raster::SnappedTriangle triangle = lookup.triangle;
    for (raster::ViewVertex& vertex : triangle.vertices) {
      vertex.u = static_cast<float>(vertex.u * map.width);
      vertex.v = static_cast<float>(vertex.v * map.height);
    }
    const glm::dvec3 sum = weightedSum(triangle, weightsAt(triangle, lookup.position));
    return texelAt(map, glm::dvec2(sum) / sum.z);
  };
  return {{"at vertices", withFetch(atVertices)},
          {"at pixels", withFetch([](const IndexMap& map, const Lookup& lookup) {
             return texelAt(map, glm::dvec2(glm::vec2(lookup.at * sizeOf(map))));
           })}};
}

/// The first and last texels end at the first and last sample, as the centres of pixels of a picture do.
std::vector<Variant> oneTexelLess() {
  const auto with = [](double rounding) {
    return withFetch([=](const IndexMap& map, const Lookup& lookup) {
      return texelAt(map, lookup.at * (sizeOf(map) - 1.0) + rounding);
    });
  };
  return {{"rounded", with(0.5)}, {"floor", with(0)}};
}

// --- filters ---

/// Linear filter of the four texels around a point, clamped to the map.
ItemId linearTexel(const std::vector<Channel>& channels, const IndexMap& map, const glm::dvec2& at) {
  const glm::dvec2 position = at * sizeOf(map) - 0.5, first = glm::floor(position), part = position - first;
  const ItemId a = texelAt(map, first), b = texelAt(map, first + glm::dvec2(1, 0));
  const ItemId c = texelAt(map, first + glm::dvec2(0, 1)), d = texelAt(map, first + 1.0);
  return idOf(channels, [&](const Channel& channel) {
    const double top = (1 - part.x) * channel.of(a) + part.x * channel.of(b);
    const double bottom = (1 - part.x) * channel.of(c) + part.x * channel.of(d);
    return (1 - part.y) * top + part.y * bottom;
  });
}

/// The next mipmap level: half the size, rounded down, at least 1. Each texel is the mean of four.
IndexMap halved(const std::vector<Channel>& channels, const IndexMap& map) {
  IndexMap half{std::max(1, map.width / 2), std::max(1, map.height / 2), {}};
  for (int row = 0; row < half.height; ++row)
    for (int column = 0; column < half.width; ++column)
      half.ids.push_back(idOf(channels, [&](const Channel& channel) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) sum += channel.of(texelAt(map, glm::dvec2(2 * column + k % 2, 2 * row + k / 2)));
        return sum / 4;
      }));
  return half;
}

using Levels = std::vector<IndexMap>;

Levels levelsOf(const std::vector<Channel>& channels, const IndexMap& map) {
  Levels levels{map};
  while (levels.back().ids.size() > 1) levels.push_back(halved(channels, levels.back()));
  return levels;
}

/// log2 of the number of texels per pixel, along the longer side of its footprint.
double levelOfDetail(const IndexMap& map, const Lookup& lookup) {
  const raster::Weights edges = weightsAt(lookup.triangle, lookup.position);
  const double total = weightedSum(lookup.triangle, edges).z;
  const auto texelsPer = [&](const raster::SnappedPoint& pixel) {
    raster::Weights steps = weightsAt(lookup.triangle, {lookup.position.x + pixel.x, lookup.position.y + pixel.y});
    for (std::size_t k = 0; k < 3; ++k) steps[k] -= edges[k];
    const glm::dvec3 change = weightedSum(lookup.triangle, steps);
    return glm::length((glm::dvec2(change) - lookup.at * change.z) / total * sizeOf(map));
  };
  return std::log2(std::max(texelsPer({256, 0}), texelsPer({0, 256})));
}

/// The lookup with mipmaps; magnified maps follow the rules.
ItemId mipmappedTexel(const std::vector<Channel>& channels, const Levels& levels, bool isLinear, bool betweenLevels,
                      const Lookup& lookup) {
  const double detail = levelOfDetail(levels.front(), lookup);
  if (!(detail > 0)) return nearestTexel(levels.front(), lookup.at);
  const auto texelOf = [&](double level) {
    const IndexMap& map = levels[static_cast<std::size_t>(std::min(level, static_cast<double>(levels.size() - 1)))];
    return isLinear ? linearTexel(channels, map, lookup.at) : nearestTexel(map, lookup.at);
  };
  if (!betweenLevels) return texelOf(std::floor(detail + 0.5));
  const double first = std::floor(detail), part = detail - first;
  const ItemId fine = texelOf(first), coarse = texelOf(first + 1);
  return idOf(channels,
              [&](const Channel& channel) { return (1 - part) * channel.of(fine) + part * channel.of(coarse); });
}

/// The channels that a filter may use: those of the format, and the bytes of an item ID of one 32-bit channel.
std::vector<std::vector<Channel>> filteredChannels(const raster::IdFormat& format) {
  const std::vector<Channel> channels = channelsOf(format), colours = colourChannelsOf(format);
  if (channels.size() == colours.size()) return {channels};
  return {channels, colours};
}

std::vector<Variant> linearFilters(const raster::IdFormat& format) {
  std::vector<Variant> variants;
  for (const std::vector<Channel>& channels : filteredChannels(format))
    variants.push_back({variants.empty() ? "" : "by bytes", withFetch([=](const IndexMap& map, const Lookup& lookup) {
                          return linearTexel(channels, map, lookup.at);
                        }),
                        channels});
  return variants;
}

std::vector<Variant> mipmappings(const raster::DrawList& list) {
  std::vector<Variant> variants;
  for (const std::vector<Channel>& channels : filteredChannels(list.format)) {
    const auto maps = std::make_shared<std::vector<Levels>>();  // one copy for all variants
    for (const IndexMap& map : list.indexMaps) maps->push_back(levelsOf(channels, map));
    for (const bool betweenLevels : {false, true})
      for (const bool isLinear : {false, true}) {
        const auto fetch = [=](const raster::DrawList&, std::size_t map, const Lookup& lookup) {
          return mipmappedTexel(channels, (*maps)[map], isLinear, betweenLevels, lookup);
        };
        const std::string name = isLinear ? "linear in " : "nearest in ";
        variants.push_back(
            {name + (betweenLevels ? "two levels" : "one level"), withStage(&StagedDevice::fetch, fetch), channels});
      }
  }
  return variants;
}

/// Index maps with reordered texels, as image libraries may load them.
Variant reordered(const std::string& name, const std::function<glm::dvec2(const IndexMap&, const glm::dvec2&)>& from) {
  const auto upload = [=](raster::DrawList& list) {
    for (IndexMap& map : list.indexMaps) {
      const IndexMap source = map;
      std::size_t texel = 0;
      for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column)
          map.ids[texel++] = texelAt(source, from(source, glm::dvec2(column, row)));
    }
  };
  return {name, withStage(&StagedDevice::upload, upload)};
}

/// Index maps column by column in memory, or u and v exchanged.
std::vector<Variant> transposedMaps() {
  return {reordered("stored column by column",
                    [](const IndexMap& map, const glm::dvec2& texel) {
                      const int k = static_cast<int>(texel.y) * map.width + static_cast<int>(texel.x);
                      return glm::dvec2(k / map.height, k % map.height);
                    }),
          {"u and v exchanged", withFetch([](const IndexMap& map, const Lookup& lookup) {
             return nearestTexel(map, {lookup.at.y, lookup.at.x});
           })}};
}

void exchangeSizes(raster::DrawList& list) {
  for (IndexMap& map : list.indexMaps) std::swap(map.width, map.height);
}

}  // namespace

std::vector<Fault> textureFaults(const TestVector& vector) {
  const raster::DrawList& list = vector.list;
  return {
      {"affine instead of perspective interpolation",
       "look for noperspective, or for a division by w before the device's own",
       {{"", withStage(&StagedDevice::interpolate, withoutPerspective)}}},
      {"linear filtering", "set the minifying and the magnifying filter to nearest", linearFilters(list.format)},
      {"mipmapping", "set a minifying filter without mipmaps, and make no mipmaps", mipmappings(list)},
      {"repeat instead of clamp",
       "set the wrap mode of both coordinates to clamp to edge",
       {{"repeated", withFetch(repeatedTexel)},
        {"repeated, also just below 0", withFetch(repeatedTexelBelow)},
        {"repeated, in fixed point", withFetch(repeatedTexelInFixedPoint)},
        {"repeated, in some pixels at the borders", withFetch(repeatedTexelAtBorders), {}, true},
        {"mirrored", withFetch(mirroredTexel)}}},
      {"border colour beyond the map", "set the wrap mode of both coordinates to clamp to edge", borders(list.format)},
      {"size of the index map a power of two", "upload index maps with their own size", powersOfTwo()},
      {"texels at u (N - 1)", "texel i covers i/N to (i + 1)/N: multiply by the number of texels", oneTexelLess()},
      {"u N rounded to binary32",
       "near a border of texels the product of two binary32 numbers needs 48 bits: multiply in double precision, and "
       "look for a compiler that rounds",
       roundedProducts()},
      {"half-texel shift", "texel i covers i/N to (i + 1)/N: leave out any half texel of a filter or of Direct3D 9",
       halfTexelShifts()},
      {"truncated texture coordinates (16.8)",
       "texture coordinates need more than 8 fractional bits",
       {{"", withFetch(truncatedTexel)}}},
      {"index map upside down",
       "row 0 is at v = 0 and comes first: image libraries may reverse rows",
       {reordered(
            "rows reversed",
            [](const IndexMap& map, const glm::dvec2& texel) { return glm::dvec2(texel.x, map.height - 1 - texel.y); }),
        reordered("columns reversed",
                  [](const IndexMap& map, const glm::dvec2& texel) {
                    return glm::dvec2(map.width - 1 - texel.x, texel.y);
                  })}},
      {"texture coordinates in half floats",
       "a half float has 11 significant bits: use 32-bit floats for attributes and high precision in shaders",
       halfFloats()},
      {"texture coordinates just below the exact ones",
       "a coordinate that is equal at all corners must stay equal in between, or a sample on the border of a texel "
       "shows the one before: interpolate in double precision, or pass texel numbers",
       justBelow()},
      {"index map transposed",
       "a map is stored row by row, u along its width: look at the order of loops, and of u and v", transposedMaps()},
      {"width and height of the index map exchanged",
       "a map has `height` rows of `width` item IDs: look at the size of the upload",
       {{"", withStage(&StagedDevice::upload, exchangeSizes)}}},
      {"index map not sampled",
       "texel 0 everywhere: an incomplete texture, or one that is not bound, reads as zero",
       {{"", withFetch([](const IndexMap&, const Lookup&) { return ItemId{0}; })}}}};
}

}  // namespace hemitex::reference
