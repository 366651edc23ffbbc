/// The item ID of an offset and a texel: channels and their clamping, whole item IDs, reserved item IDs.
#include <set>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/colour_channels.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

Picture emptyPicture(int resolution, const raster::IdFormat& format, raster::Blend operation) {
  Picture picture(resolution);
  picture.format = format;
  picture.blend = operation;
  return picture;
}

/// Row j of the picture blends offset j with every texel in turn.
void addTable(Picture& picture, const std::vector<ItemId>& offsets, const std::vector<ItemId>& texels) {
  picture.indexMaps.push_back({static_cast<int>(texels.size()), 1, texels});
  for (int row = 0; row < static_cast<int>(offsets.size()); ++row) {
    addDraw(picture, offsets[static_cast<std::size_t>(row)], {}, static_cast<int>(picture.indexMaps.size()) - 1);
    picture.addBlock({0, row, static_cast<int>(texels.size()), row + 1});
  }
}

/// One pixel of a triangle that faces away, with a back item ID.
void addBack(Picture& picture, int column, int row) {
  addDraw(picture, 1, raster::backId(picture.format));
  picture.addPixel(column, row);
  turnLastDraw(picture);
}

/// Pixel (i, j) adds texel byte i to offset byte j in every channel at once: as (i, j), (255 - i, 255 - j), (i, 255 -
/// j) and (255 - i, j). So each channel meets all pairs, and never do all four reach 255, which is the background: the
/// first two do where i + j = 255, the last two where i = j.
TestVector bytePairs() {
  constexpr ItemId all = 255;
  std::vector<ItemId> offsets, texels;
  for (ItemId byte = 0; byte <= all; ++byte) {
    texels.push_back(byte | (all - byte) << 8 | byte << 16 | (all - byte) << 24);
    offsets.push_back(byte | (all - byte) << 8 | (all - byte) << 16 | byte << 24);
  }
  Picture picture = emptyPicture(256, {{8, 8, 8, 8}}, raster::Blend::ClampedAdd);
  addTable(picture, offsets, texels);
  return makeVector("byte-pairs", "wrapping instead of clamping, carries between channels, any byte sum that is wrong",
                    picture);
}

/// Offsets and texels of one bit each, in every combination, and texels that fill a channel but for its last bit: sums
/// show where one channel ends and the next begins. Beside them the background and, in the last pixel, a back.
TestVector layout(const std::string& name, const raster::IdFormat& format) {
  const int bits = raster::idBits(format);
  std::vector<ItemId> offsets, texels{0};
  for (int bit = 0; bit < bits; ++bit) offsets.push_back(ItemId{1} << bit);
  // The highest bit twice would clamp a single channel to the background.
  for (int bit = 0; bit < bits - 1; ++bit) texels.push_back(ItemId{1} << bit);
  for (const Channel& channel : channelsOf(format))
    if (channel.bits < bits) texels.push_back((channel.largest() - 1) << channel.shift);
  Picture picture = emptyPicture(48, format, raster::Blend::ClampedAdd);
  addTable(picture, offsets, texels);
  addBack(picture, 47, 47);
  return makeVector("layout-" + name, "channels cut, ordered or written back otherwise than " + name, picture);
}

/// All sums of offsets and texels around the channels' borders; some run over the end of the item ID.
TestVector integerAdd(const std::string& name, const raster::IdFormat& format) {
  const ItemId background = raster::backgroundId(format);
  Picture picture = emptyPicture(16, format, raster::Blend::IntegerAdd);
  addTable(picture,
           {0, 0x7f, 0xfe, 0xffffu - 1, background / 2 - 3, background - 5, background - 0x100, background - 0x10001},
           {0, 1, 2, 3, 0x80, 0x82, 0xff, 0x102, 0x8000, 0x10002, 0x7fff02, background - 0xff});
  return makeVector(name, "carries lost between channels, clamping of an integer add, wrapping at the wrong bit",
                    picture);
}

/// Surfaces of 3 x 3 elements whose indices follow each other without a gap; only whole item IDs can be added so.
TestVector unaligned(const std::string& name, const std::string& catches, raster::Blend operation) {
  Picture picture = emptyPicture(48, {{8, 8, 8}}, operation);
  picture.indexMaps.push_back(countingMap(3, 3));
  for (ItemId surface = 0; surface < 256; ++surface) {
    addDraw(picture, 9 * surface, {}, 0);
    const int column = static_cast<int>(surface % 16) * 3, row = static_cast<int>(surface / 16) * 3;
    picture.addBlock({column, row, column + 3, row + 3});
  }
  return makeVector(name, catches, picture);
}

/// Four surfaces, each with an index map of its own whose item IDs occur nowhere else; the offsets must not show.
TestVector uniqueMaps() {
  Picture picture = emptyPicture(32, {{8, 8, 8, 8}}, raster::Blend::Replace);
  for (int surface = 0; surface < 4; ++surface) {
    raster::IndexMap map = countingMap(16, 16);
    for (ItemId& id : map.ids) id += 0x00ff80u + 256 * static_cast<ItemId>(surface);
    picture.indexMaps.push_back(std::move(map));
    addDraw(picture, 0x01010101, raster::backId(picture.format), surface);
    const int column = surface % 2 * 16, row = surface / 2 * 16;
    picture.addBlock({column, row, column + 16, row + 16});
  }
  return makeVector("unique-maps", "modulate or add where the texel replaces the offset", picture);
}

/// Surfaces of a single element, without index map, between textured ones, two to each aligned offset and beyond.
TestVector singleElements() {
  Picture picture = emptyPicture(32, {{8, 8, 8}}, raster::Blend::ClampedAdd);
  picture.indexMaps.push_back(countingMap(16, 16));
  for (int block = 0; block < 64; ++block) {
    const bool isTextured = block % 3 == 0;
    const ItemId offset = isTextured ? static_cast<ItemId>(block) << 8 : 0x10000 + static_cast<ItemId>(block);
    addDraw(picture, offset, raster::backId(picture.format), isTextured ? std::optional<int>(0) : std::nullopt);
    const int column = block % 8 * 4, row = block / 8 * 4;
    picture.addBlock({column, row, column + 4, row + 4});
  }
  return makeVector("single-elements", "a texture left bound for surfaces without index map", picture);
}

/// Item IDs at the limits of binary32, signed integers and bytes, from 0 to the largest that a draw can produce.
std::vector<ItemId> edgeIds(int bits) {
  const ItemId reserved = static_cast<ItemId>((std::uint64_t{1} << bits) - 2);
  std::set<ItemId> ids{0, 1, 2, reserved - 1, reserved / 2, reserved / 2 + 1, reserved / 2 + 2};
  for (const int power : {8, 16, 23, 24, 25, 31})
    if (power < bits) ids.insert({(ItemId{1} << power) - 1, ItemId{1} << power, (ItemId{1} << power) + 1});
  return {ids.begin(), ids.end()};
}

/// The edge item IDs as offsets without a texel, one pixel each; then the back item ID, surrounded by the background.
TestVector edgeOffsets(const std::string& name, const raster::IdFormat& format) {
  constexpr int resolution = 16;
  Picture picture = emptyPicture(resolution, format, raster::Blend::ClampedAdd);
  int pixel = 0;
  for (const ItemId id : edgeIds(raster::idBits(format))) {
    addDraw(picture, id);
    picture.addPixel(pixel % resolution, pixel / resolution);
    ++pixel;
  }
  addBack(picture, pixel % resolution, pixel / resolution);
  return makeVector("edge-offsets-" + name, "offsets that pass through binary32, signed numbers, sRGB or dithering",
                    picture);
}

/// The edge item IDs as texels, one pixel each, in one 32-bit channel: replaced, or added modulo 2^32 to an offset.
TestVector edgeTexels(const std::string& name, raster::Blend operation, ItemId offset) {
  std::vector<ItemId> texels = edgeIds(32);
  for (ItemId& texel : texels) texel -= offset;
  Picture picture = emptyPicture(32, {{32}}, operation);
  addTable(picture, {offset}, texels);
  addBack(picture, 31, 31);
  return makeVector(name, "texels that pass through binary32, signed numbers or sRGB", picture);
}

/// Blocks with and without index map and back item ID, front-facing and back-facing, in a plain and a mirrored view.
TestVector backs() {
  Picture picture = emptyPicture(32, {{8, 8, 8}}, raster::Blend::ClampedAdd);
  picture.indexMaps.push_back(countingMap(4, 4));
  for (int block = 0; block < 16; ++block) {
    const bool isMapped = block % 2 == 1, hasBack = block / 2 % 2 == 1, isTurned = block / 4 % 2 == 1;
    const ItemId back = raster::backId(picture.format) - static_cast<ItemId>(block / 8);
    addDraw(picture, static_cast<ItemId>(block) << 8, hasBack ? std::optional<ItemId>(back) : std::nullopt,
            isMapped ? std::optional<int>(0) : std::nullopt);
    const int column = block % 4 * 8, row = block / 4 * 8;
    picture.addBlock({column, row, column + 7, row + 6});
    if (isTurned) turnLastDraw(picture);
  }
  const raster::Face plain = frontFace(32, 0.5f);
  raster::Face mirrored = plain;
  mirrored.x = -mirrored.x;
  return makeVector("backs", "backs culled, drawn as fronts, textured, or told by winding alone in a mirrored view",
                    picture, {plain, mirrored});
}

}  // namespace

std::vector<TestVector> idVectors() {
  std::vector<TestVector> vectors{bytePairs()};
  for (const std::string& name : raster::formatNames()) {
    vectors.push_back(layout(name, *raster::formatNamed(name)));
    vectors.push_back(edgeOffsets(name, *raster::formatNamed(name)));
  }
  vectors.push_back(layout("3-1-7-2", {{3, 1, 7, 2}}));
  vectors.push_back(integerAdd("integer-add-24", {{8, 8, 8}}));
  vectors.push_back(integerAdd("integer-add-32", {{32}}));
  vectors.push_back(unaligned("unaligned-integer-add", "clamping or lost carries where offsets are not aligned",
                              raster::Blend::IntegerAdd));
  vectors.push_back(unaligned("unaligned-clamped-add",
                              "carries where offsets are not aligned: clamped channels destroy such words",
                              raster::Blend::ClampedAdd));
  vectors.push_back(uniqueMaps());
  vectors.push_back(singleElements());
  vectors.push_back(edgeTexels("edge-texels-replaced", raster::Blend::Replace, 0));
  vectors.push_back(edgeTexels("edge-texels-added", raster::Blend::IntegerAdd, 0x80000005));
  vectors.push_back(backs());
  return vectors;
}

}  // namespace hemitex::reference
