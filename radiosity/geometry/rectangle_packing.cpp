#include "radiosity/geometry/rectangle_packing.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <tuple>

#define STBRP_STATIC
#define STB_RECT_PACK_IMPLEMENTATION
#include <stb/stb_rect_pack.h>

namespace hemitex::radiosity {
namespace {

/// The packer sorts its input by size with an unstable sort. Rectangles of equal size are interchangeable, so that the
/// set of their places is the same for any order. Assigning these places in a fixed order, lower places to earlier
/// rectangles, makes the result deterministic.
void handOutPlaces(std::vector<stbrp_rect>& rectangles) {
  std::vector<std::size_t> bySize(rectangles.size());
  std::iota(bySize.begin(), bySize.end(), std::size_t{0});
  const auto size = [&](std::size_t i) { return std::tuple(rectangles[i].h, rectangles[i].w); };
  std::stable_sort(bySize.begin(), bySize.end(), [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
  std::vector<stbrp_rect> places;
  for (auto first = bySize.begin(); first != bySize.end();) {
    const auto last = std::find_if(first, bySize.end(), [&](std::size_t i) { return size(i) != size(*first); });
    places.clear();
    for (auto i = first; i != last; ++i) places.push_back(rectangles[*i]);
    std::sort(places.begin(), places.end(), [](const stbrp_rect& a, const stbrp_rect& b) {
      return std::tuple(!a.was_packed, a.y, a.x) < std::tuple(!b.was_packed, b.y, b.x);
    });
    for (const stbrp_rect& place : places) {
      stbrp_rect& rectangle = rectangles[*first++];
      rectangle.x = place.x;
      rectangle.y = place.y;
      rectangle.was_packed = place.was_packed;
    }
  }
}

/// Packs the rectangles `members` (numbers in `sizes`) into a square, as far as they fit; `id` is the number.
std::vector<stbrp_rect> packSquare(const std::vector<RectangleSize>& sizes, const std::vector<int>& members, int side) {
  std::vector<stbrp_rect> rectangles;
  for (int member : members) {
    const RectangleSize& size = sizes[static_cast<std::size_t>(member)];
    rectangles.push_back({member, size.width, size.height, 0, 0, 0});
  }
  std::vector<stbrp_node> nodes(static_cast<std::size_t>(side));
  stbrp_context context{};
  stbrp_init_target(&context, side, side, nodes.data(), side);
  stbrp_pack_rects(&context, rectangles.data(), static_cast<int>(rectangles.size()));
  handOutPlaces(rectangles);
  return rectangles;
}

/// Whether all members can fit by area and sides: avoids packing attempts that must fail.
bool mayHold(const std::vector<RectangleSize>& sizes, const std::vector<int>& members, int side) {
  std::int64_t area = 0;
  for (int member : members) {
    const RectangleSize& size = sizes[static_cast<std::size_t>(member)];
    if (std::max(size.width, size.height) > side) return false;
    area += std::int64_t{size.width} * size.height;
  }
  return area <= std::int64_t{side} * side;
}

/// Adds one page with as many members as fit, and leaves the others in `members`.
void addPage(const std::vector<RectangleSize>& sizes, int largestSide, std::vector<int>& members, Packing& packing) {
  int side = 1;
  std::vector<stbrp_rect> rectangles;
  for (; side <= largestSide; side *= 2) {
    if (side < largestSide && !mayHold(sizes, members, side)) continue;
    rectangles = packSquare(sizes, members, side);
    const auto packed = [](const stbrp_rect& rectangle) { return rectangle.was_packed != 0; };
    if (side == largestSide || std::all_of(rectangles.begin(), rectangles.end(), packed)) break;
  }
  members.clear();
  for (const stbrp_rect& rectangle : rectangles) {
    if (!rectangle.was_packed) {
      members.push_back(rectangle.id);
      continue;
    }
    packing.places[static_cast<std::size_t>(rectangle.id)] = {static_cast<int>(packing.pages.size()), rectangle.x,
                                                              rectangle.y};
  }
  packing.pages.push_back({side, side});
}

}  // namespace

Packing packRectangles(const std::vector<RectangleSize>& sizes, int largestSide) {
  Packing packing{{}, std::vector<RectanglePlace>(sizes.size())};
  std::vector<int> members, oversized;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    assert(sizes[i].width > 0 && sizes[i].height > 0);
    const bool fits = std::max(sizes[i].width, sizes[i].height) <= largestSide;
    (fits ? members : oversized).push_back(static_cast<int>(i));
  }
  while (!members.empty()) addPage(sizes, largestSide, members, packing);
  for (int index : oversized) {
    packing.places[static_cast<std::size_t>(index)] = {static_cast<int>(packing.pages.size()), 0, 0};
    packing.pages.push_back(sizes[static_cast<std::size_t>(index)]);
  }
  return packing;
}

}  // namespace hemitex::radiosity
