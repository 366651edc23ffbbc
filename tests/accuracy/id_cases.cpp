#include "tests/accuracy/id_cases.h"

#include <algorithm>

#include "radiosity/index_maps/id_layout.h"
#include "raster/base/input_error.h"

namespace hemitex::accuracy {
namespace {

using namespace radiosity;
using raster::ItemId;

/// The texels of a surface of 2^k texels, as an almost square grid.
Grid gridOf(int indexBits) {
  Grid grid;
  grid.columns = 1 << (indexBits - indexBits / 2);
  grid.rows = 1 << (indexBits / 2);
  return grid;
}

/// Surfaces that use all item IDs of a format. The last surface is a strip, which may be two texels short.
Discretization filled(const IdCase& example, bool isShort) {
  Discretization discretization;
  discretization.grids.assign(example.surfaces - 1, gridOf(example.indexBits));
  Grid last;
  last.columns = static_cast<int>((std::int64_t{1} << example.indexBits) - (isShort ? 2 : 1));
  if (last.columns > 0) discretization.grids.push_back(last);
  return discretization;
}

IdLayout layoutOf(const IdCase& example, bool isShort) {
  return layOut(filled(example, isShort), {example.format, raster::Blend::ClampedAdd, true});
}

std::string refusalOf(const IdCase& example) {
  try {
    layoutOf(example, false);
  } catch (const raster::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

std::vector<IdCase> idCases() {
  std::vector<IdCase> cases;
  for (int k = 1; k <= 31; ++k) {
    const auto [format, bits] = k < 16   ? std::pair("r5g6b5", 16)
                                : k < 24 ? std::pair("r8g8b8", 24)
                                         : std::pair("r8g8b8a8", 32);
    cases.push_back({k, format, std::uint64_t{1} << (bits - k), {}});
    cases.back().refusal = refusalOf(cases.back());
  }
  return cases;
}

bool isOneToOne(const IdCase& example) {
  const Discretization discretization = filled(example, true);
  const IdLayout layout = layoutOf(example, true);
  const ItemId background = raster::backgroundId(layout.format);
  const auto standsFor = [&](std::uint32_t surface, ItemId texel) {
    const ItemId id = raster::blend(layout.format, layout.blend, layout.pages[surface].offset, texel);
    const auto found = pageIndexOf(layout, id);
    return id == layout.pages[surface].offset + texel && id < background - 1 && found && found->page == surface &&
           found->index == texel;
  };
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    const Grid& grid = discretization.grids[s];
    const ItemId texels = static_cast<ItemId>(grid.columns) * static_cast<ItemId>(grid.rows);
    for (const ItemId texel : {ItemId{0}, texels / 3, texels - 1})
      if (!standsFor(s, texel)) return false;
  }
  return layout.indexBits == std::max(1, example.indexBits) && !pageIndexOf(layout, background) &&
         !pageIndexOf(layout, background - 1);
}

}  // namespace hemitex::accuracy
