#include "cli/vector/profile_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "raster/base/short_number.h"
#include "reference/base/markup_text.h"
#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::cli {
namespace {

using raster::ItemBuffer;
using raster::shortNumber;
using reference::markupText;

constexpr const char *good = "#4a9", *bad = "#c43", *first = "#9cf", *second = "#fd9";

constexpr const char* profileStyle = R"(<style>
body { font: 16px/1.4 sans-serif; max-width: 56em; margin: 1em auto; padding: 0 1em; }
table { border-collapse: collapse; }
th, td { padding: 0 1.5em 0 0; text-align: left; }
svg { max-width: 100%; font: 12px sans-serif; }
</style>
)";

// --- drawing ---

std::string picture(int width, int height, const std::string& content) {
  return "<svg viewBox=\"0 0 " + std::to_string(width) + ' ' + std::to_string(height) + "\" width=\"" +
         std::to_string(width) + "\" role=\"img\">\n" + content + "</svg>\n";
}

std::string text(double x, double y, const std::string& words, const char* anchor = "start") {
  return "<text x=\"" + shortNumber(x) + "\" y=\"" + shortNumber(y) + "\" text-anchor=\"" + anchor + "\">" +
         markupText(words) + "</text>\n";
}

std::string rectangle(double x, double y, double width, double height, const std::string& colour) {
  return "<rect x=\"" + shortNumber(x) + "\" y=\"" + shortNumber(y) + "\" width=\"" + shortNumber(width) +
         "\" height=\"" + shortNumber(height) + "\" fill=\"" + colour + "\"/>\n";
}

/// A row of a bar chart.
struct Bar {
  std::string name;
  double value, largest;  ///< above 0
  std::string words;      ///< behind the bar
  bool isGood;
};

std::string bars(const std::vector<Bar>& all) {
  constexpr int rowHeight = 18, left = 280, width = 360;
  std::string content;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Bar& bar = all[k];
    const double top = static_cast<double>(k) * rowHeight, share = bar.value / bar.largest;
    content += text(left - 8, top + 13, bar.name, "end") +
               rectangle(left, top + 3, std::max(1.0, share * width), rowHeight - 6, bar.isGood ? good : bad) +
               text(left + share * width + 6, top + 13, bar.words);
  }
  return picture(left + width + 140, static_cast<int>(all.size()) * rowHeight, content);
}

/// The bar of a part of all.
Bar partOf(const std::string& name, int part, int all, bool isGood) {
  const std::string words = std::to_string(part) + " of " + std::to_string(all);
  return {name, static_cast<double>(part), static_cast<double>(std::max(all, 1)), words, isGood};
}

// --- properties ---

std::string snapping(const ProfilePage& page) {
  const reference::DeviceProfile& profile = page.calibration.profile;
  std::vector<Bar> all;
  for (const reference::SnappingFit& fit : snappingFits(page.probes, page.answers)) {
    const bool isExact = fit.rounding == reference::SnapRounding::None;
    const bool isMeasured = fit.rounding == profile.snapRounding && (isExact || fit.bits == profile.subpixelBits);
    const std::string name =
        isExact ? "not snapped"
                : std::to_string(fit.bits) + " bits, " +
                      (fit.rounding == reference::SnapRounding::Nearest ? "to the nearest" : "truncated");
    all.push_back(partOf(name, fit.contradictions, fit.probes, isMeasured));
    if (isMeasured) all.back().words += ", measured";
  }
  return "<h2>Sub-pixel grid</h2>\n<p>Each probe is a triangle that covers a sample, or not, depending on how its "
         "corners are snapped. The bars are the samples that contradict a snapping. The measured one has none.</p>\n" +
         bars(all);
}

std::string polygon(const std::array<glm::ivec2, 3>& corners, double x, double y, double scale,
                    const std::string& colour) {
  std::string points;
  for (const glm::ivec2& corner : corners)
    points += shortNumber(x + scale * corner.x) + ',' + shortNumber(y + scale * corner.y) + ' ';
  return "<polygon points=\"" + points + "\" fill=\"" + colour + "\"/>\n";
}

/// Pairs of triangles and a sample on their edge, which has the colour of the triangle that the device gave it to.
std::string edgeRule(const ProfilePage& page) {
  constexpr int columns = 8, rows = 3, side = 84;
  const reference::ProbeSheet<reference::SharedEdgeProbe>& sheet = page.probes.sharedEdges.front();
  const ItemBuffer& answer = page.answers[page.probes.coverage.size()];
  std::string content;
  for (int k = 0; k < columns * rows && 8 * static_cast<std::size_t>(k) < sheet.pixels.size(); ++k) {
    const std::size_t pixel = 8 * static_cast<std::size_t>(k);
    const auto& triangles = sheet.pixels[pixel].triangles;
    const double x = (k % columns + 0.5) * side, y = (k / columns + 0.5) * side;
    int largest = 1;
    for (const reference::CoverageProbe& probe : triangles)
      for (const glm::ivec2& corner : probe.corners)
        largest = std::max({largest, std::abs(corner.x), std::abs(corner.y)});
    for (const std::size_t t : {0u, 1u})
      content += polygon(triangles[t].corners, x, y, 0.45 * side / largest, t == 0 ? first : second);
    const raster::ItemId id = answer.ids[pixel];
    content += "<circle cx=\"" + shortNumber(x) + "\" cy=\"" + shortNumber(y) + "\" r=\"5\" stroke=\"#000\" fill=\"" +
               (id == 1   ? first
                : id == 2 ? second
                          : bad) +
               "\"/>\n";
  }
  return std::string(
             "<h2>Edge rule</h2>\n<p>Each pair of triangles shares an edge through the sample. The dot has "
             "the colour of the triangle to which the device gave the sample; red is none. Rows grow "
             "downwards. With the top-left rule a sample belongs to the triangle below or right of its edge. "
             "Measured: ") +
         (page.calibration.profile.edgeRule == reference::EdgeRule::TopLeft ? "top-left" : "another rule") + ".</p>\n" +
         picture(columns * side, rows * side, content);
}

/// Wrong samples by the distance of their coordinate from a border of texels.
std::string texels(const ProfilePage& page) {
  constexpr int farthest = 2, nearest = 24;  // powers of 1/2 texel
  std::vector<int> counts(nearest + 1), wrong(nearest + 1);
  std::size_t sheet = page.probes.coverage.size() + page.probes.sharedEdges.size();
  for (const auto* sheets : {&page.probes.texels, &page.probes.interpolation})
    for (const auto& probes : *sheets) {
      for (std::size_t pixel = 0; pixel < probes.pixels.size(); ++pixel) {
        const reference::TexelProbe& probe = probes.pixels[pixel];
        if (probe.distance >= 1) continue;
        const int power = std::clamp(-std::ilogb(std::max(probe.distance, 0x1p-40)) - 1, farthest, nearest);
        const raster::ItemId right = probe.isAbove ? probe.above : probe.above - 1;
        ++counts[static_cast<std::size_t>(power)];
        wrong[static_cast<std::size_t>(power)] += page.answers[sheet].ids[pixel] != right;
      }
      ++sheet;
    }
  std::vector<Bar> all;
  for (int power = farthest; power <= nearest; ++power) {
    const int count = counts[static_cast<std::size_t>(power)], failed = wrong[static_cast<std::size_t>(power)];
    if (count == 0) continue;
    const std::string name =
        power == nearest ? "nearer, or on the border" : "up to 1/" + std::to_string(1 << power) + " texel";
    all.push_back(partOf(name, failed, count, failed == 0));
  }
  return "<h2>Texel addressing</h2>\n<p>Each probe shows a coordinate beside a border of two texels. The bars are the "
         "samples that show the texel beyond the border, by the distance from it. Measured: an error of " +
         shortNumber(page.calibration.profile.texelPrecision) + " texels, and " +
         shortNumber(page.calibration.profile.interpolationError) + " roundings of interpolation.</p>\n" + bars(all);
}

std::string depths(const ProfilePage& page) {
  constexpr std::array<const char*, 4> names{"steps of 16 bits", "steps of float32 near 1", "steps of 24 bits",
                                             "steps of float32 near 0"};
  std::array<int, 4> counts{}, right{};
  std::size_t sheet = page.answers.size() - page.probes.clipping.size() - page.probes.depths.size();
  for (const auto& probes : page.probes.depths) {
    for (std::size_t pixel = 0; pixel < probes.pixels.size(); ++pixel) {
      const auto step = static_cast<std::size_t>(probes.pixels[pixel].step);
      ++counts[step];
      right[step] += page.answers[sheet].ids[pixel] == probes.pixels[pixel].nearer;
    }
    ++sheet;
  }
  std::vector<Bar> all;
  for (std::size_t step = 0; step < names.size(); ++step)
    all.push_back(partOf(names[step], right[step], counts[step], right[step] == counts[step]));
  return "<h2>Depth</h2>\n<p>Each probe is a pair of triangles with a small difference in depth. The bars are the "
         "samples that show the nearer triangle.</p>\n" +
         bars(all);
}

/// The share of equal item IDs of a device that clips in some way.
Bar clippingBar(const ProfilePage& page, const std::string& name, const reference::StagedDevice& device) {
  int pixels = 0, equal = 0;
  const std::size_t begin = page.answers.size() - page.probes.clipping.size();
  for (std::size_t k = 0; k < page.probes.clipping.size(); ++k) {
    std::size_t pixel = 0;
    const ItemBuffer& answer = page.answers[begin + k];
    drawOn(device, placeVector(page.probes.clipping[k]), [&](const ItemBuffer& part) {
      for (const raster::ItemId id : part.ids) {
        ++pixels;
        equal += id == answer.ids[pixel++];
      }
      return pixel < answer.ids.size();
    });
  }
  return partOf(name, equal, pixels, equal == pixels);
}

std::string clipping(const ProfilePage& page) {
  std::vector<Bar> all{clippingBar(page, "as the rules: near plane first", {})};
  for (const reference::Fault& fault : reference::geometryFaults(page.probes.clipping.front()))
    if (fault.name == "clipping at other planes")
      for (const reference::Variant& variant : fault.variants)
        all.push_back(clippingBar(page, variant.name, variant.device));
  return "<h2>Clipping</h2>\n<p>The probes reach beyond the view and behind the near plane. The bars are the pixels "
         "that equal those of a device that clips in this way. The profile allows any of them that keeps the near "
         "plane.</p>\n" +
         bars(all);
}

}  // namespace

std::string toHtml(const ProfilePage& page) {
  const std::string title = "Profile of " + markupText(page.device);
  std::string table = "<table>\n";
  const nlohmann::ordered_json profile = toJson(page.calibration.profile);
  for (const auto& [key, value] : profile.items())
    table += "<tr><th>" + key + "<td>" + markupText(value.is_string() ? value.get<std::string>() : value.dump()) + "\n";
  return "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>" + title + "</title>\n" +
         profileStyle + "<h1>" + title +
         "</h1>\n<p>Measured by the probes of hemitex: what this device may round, and how.</p>\n" + table +
         "</table>\n" + snapping(page) + edgeRule(page) + texels(page) + depths(page) + clipping(page);
}

}  // namespace hemitex::cli
