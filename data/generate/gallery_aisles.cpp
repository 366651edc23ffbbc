/// The aisles of the hall: the library with windows and built-in bookcases, and the gallery with paintings.
#include <algorithm>

#include "data/generate/curves.h"
#include "data/generate/furniture.h"
#include "data/generate/gallery_plan.h"
#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

/// A wall's part with a tall window of five panes: wall, reveal, glass and bars.
void addWindow(std::vector<Group>& groups, const std::string& name, const Wall& wall, const Rectangle& place,
               const std::string& material) {
  constexpr double depth = 0.3, bar = 0.03;
  const double middle = (place.left + place.right) / 2;
  const Arch arch{middle, 0.7, 1, 2.7, 10};
  groups.push_back({name + "-wall", material, aroundArch(wall, {place.left, place.right, arch.sill, place.top}, arch)});
  groups.push_back({name + "-below", material, {panel(wall, {place.left, place.right, place.bottom, arch.sill})}});
  groups.push_back({name + "-reveal", "stone", reveal(wall, outline(arch), depth, true)});
  const Rectangle lower{middle - arch.radius, middle + arch.radius, arch.sill, arch.spring};
  const double half = (arch.sill + arch.spring) / 2;
  const std::vector<Rectangle> panes{{lower.left, middle - bar, lower.bottom, half - bar},
                                     {middle + bar, lower.right, lower.bottom, half - bar},
                                     {lower.left, middle - bar, half + bar, lower.top - 2 * bar},
                                     {middle + bar, lower.right, half + bar, lower.top - 2 * bar}};
  groups.push_back({name + "-bars", "iron", panels(wall, cutOut(lower, panes), depth)});
  int number = 0;
  for (const Rectangle& glass : panes)
    groups.push_back({name + "-pane-" + std::to_string(++number), "light-window", {panel(wall, glass, depth)}});
  Arch head = arch;
  head.sill = head.spring;
  groups.push_back({name + "-head", "light-window", {pane(wall, outline(head), depth)}});
}

// Of the two bookcases side by side.
constexpr double bookcaseHalf = 1.5, stile = 0.08, board = 0.05, base = 0.25, shelfHeight = 0.45;
constexpr int shelves = 5;

Rectangle bookcaseWall() {
  return span(libraryWall(), bayStart(bookcaseBay), bayStart(bookcaseBay + 1), 0, aisleHeight);
}

/// The upright pieces and boards of the bookcases, their niches, and the wall around them.
void addBookcases(std::vector<Group>& groups, const std::string& name) {
  const Wall wall = libraryWall();
  const Rectangle place = bookcaseWall();
  const double middle = (place.left + place.right) / 2, height = base + shelves * (shelfHeight + board);
  const Rectangle whole{middle - bookcaseHalf, middle + bookcaseHalf, 0, height};
  const auto add = [&](const std::string& part, const std::vector<Polygon>& polygons) {
    groups.push_back({name + part, "walnut", polygons});
  };
  groups.push_back({name + "-wall", "sage", panels(wall, cutOut(place, {whole}))});
  int number = 0;
  for (const double s : {whole.left, middle - stile / 2, whole.right - stile})
    add("-stile-" + std::to_string(++number), {panel(wall, {s, s + stile, 0, height})});
  number = 0;
  for (const Rectangle& niche : bookNiches()) {
    const std::string which = std::to_string(++number);
    if (niche.bottom == base) add("-base-" + which, {panel(wall, {niche.left, niche.right, 0, base})});
    add("-board-" + which, {panel(wall, {niche.left, niche.right, niche.top, niche.top + board})});
    add("-niche-" + which, reveal(wall, outline(niche), nicheDepth, true));
    add("-niche-back-" + which, {panel(wall, niche, nicheDepth)});
  }
}

/// A part of the wall with a hole for a painting.
void addPaintedWall(std::vector<Group>& groups, const std::string& name, const Wall& wall, const Rectangle& place,
                    const std::string& material, double width, double height, const std::vector<ColourPatch>& canvas) {
  const double middle = (place.left + place.right) / 2, eyeHeight = 1.75;
  const Rectangle hole{middle - width / 2, middle + width / 2, eyeHeight - height / 2, eyeHeight + height / 2};
  groups.push_back({name + "-wall", material, panels(wall, cutOut(place, {hole}))});
  append(groups, placed(painting(wall, hole, "gilt", canvas), name, {0, 0, 0}));
}

// Compositions of the paintings.
std::vector<ColourPatch> blueCanvas() {
  return {{{0, 0.3, 0, 0.55}, "cobalt"},   {{0, 0.3, 0.55, 1}, "tile-light"}, {{0.3, 0.75, 0, 0.25}, "gilt"},
          {{0.3, 0.75, 0.25, 1}, "azure"}, {{0.75, 1, 0, 0.7}, "ivory"},      {{0.75, 1, 0.7, 1}, "pompeian"}};
}
std::vector<ColourPatch> redCanvas() {
  return {{{0, 0.62, 0.4, 1}, "pompeian"},
          {{0, 0.2, 0, 0.4}, "ivory"},
          {{0.2, 0.62, 0, 0.4}, "cobalt"},
          {{0.62, 1, 0.75, 1}, "gilt"},
          {{0.62, 1, 0, 0.75}, "ivory"}};
}
std::vector<ColourPatch> greenCanvas() {
  return {{{0, 1, 0, 0.3}, "bottle"},
          {{0, 1, 0.3, 0.45}, "celadon"},
          {{0, 0.55, 0.45, 1}, "ivory"},
          {{0.55, 0.8, 0.45, 1}, "gilt"},
          {{0.8, 1, 0.45, 1}, "terracotta"}};
}

}  // namespace

Wall libraryWall() { return wallAtX(-outerSide, true); }

std::vector<Rectangle> bookNiches() {
  const Rectangle place = bookcaseWall();
  const double middle = (place.left + place.right) / 2;
  std::vector<Rectangle> niches;
  for (const double left : {middle - bookcaseHalf + stile, middle + stile / 2})
    for (int shelf = 0; shelf < shelves; ++shelf) {
      const double bottom = base + shelf * (shelfHeight + board);
      niches.push_back({left, left + bookcaseHalf - 1.5 * stile, bottom, bottom + shelfHeight});
    }
  return niches;
}

void addCeiling(std::vector<Group>& groups, const std::string& side, const std::string& cofferMaterial) {
  const double sign = sideSign(side), depth = 0.25, inset = 0.7;
  const double left = std::min(sign * aisleSide, sign * outerSide),
               right = std::max(sign * aisleSide, sign * outerSide);
  for (int bay = 0; bay < bays; ++bay) {
    const std::string name = side + "-ceiling-" + std::to_string(bay + 1);
    const double back = bayStart(bay), front = bayStart(bay + 1);
    const Polygon outer = rectangle(left, right, back, front, aisleHeight);
    const Polygon inner = rectangle(left + inset, right - inset, back + inset, front - inset, aisleHeight);
    const Polygon top = atHeight(inner, aisleHeight + depth);
    groups.push_back({name, "plaster", reversed(frame(outer, inner))});
    groups.push_back({name + "-coffer-sides", "plaster", reversed(band(top, aisleHeight))});
    groups.push_back({name + "-coffer", cofferMaterial, {reversed(top)}});
  }
}

void addLibraryWalls(std::vector<Group>& groups) {
  const Wall wall = libraryWall();
  for (int bay = 0; bay < bays; ++bay) {
    const std::string name = "library-" + std::to_string(bay + 1);
    const Rectangle place = span(wall, bayStart(bay), bayStart(bay + 1), 0, aisleHeight);
    if (bay == bookcaseBay)
      addBookcases(groups, name + "-bookcases");
    else if (bay == paintedBay)
      addPaintedWall(groups, name, wall, place, "sage", 1.5, 2, greenCanvas());
    else
      addWindow(groups, name + "-window", wall, place, "sage");
  }
  for (const bool apseEnd : {true, false}) {
    const Wall end = wallAtZ(apseEnd ? -halfLength : halfLength, apseEnd);
    addWindow(groups, apseEnd ? "library-window-apse" : "library-window-door", end,
              span(end, -outerSide, -aisleSide, 0, aisleHeight), "sage");
  }
}

void addGalleryWalls(std::vector<Group>& groups) {
  const Wall wall = wallAtX(outerSide, false);
  const auto place = [&](int bay) { return span(wall, bayStart(bay), bayStart(bay + 1), 0, aisleHeight); };
  addPaintedWall(groups, "gallery-1", wall, place(0), "ochre", 2, 1.5, redCanvas());
  const double half = portalHalfWidth();
  groups.push_back({"gallery-2-wall", "ochre",
                    panels(wall, cutOut(place(1), {span(wall, rotundaZ - half, rotundaZ + half, 0, portalHeight)}))});
  addPaintedWall(groups, "gallery-3", wall, place(2), "ochre", 1.5, 2, greenCanvas());
  addPaintedWall(groups, "gallery-4", wall, place(3), "ochre", 2.2, 1.4, blueCanvas());
  for (const bool apseEnd : {true, false}) {
    const Wall end = wallAtZ(apseEnd ? -halfLength : halfLength, apseEnd);
    addWindow(groups, apseEnd ? "gallery-window-apse" : "gallery-window-door", end,
              span(end, aisleSide, outerSide, 0, aisleHeight), "ochre");
  }
}

}  // namespace hemitex::data
