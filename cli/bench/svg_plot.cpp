#include "cli/bench/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "reference/diagnosis/xml_text.h"

namespace hemitex::cli {
namespace {

constexpr double width = 720, height = 440, left = 70, right = 190, top = 40, bottom = 56;
constexpr double lineHeight = 15;

/// Of the eight colours that Okabe and Ito (2008) chose for all eyes, those that are dark enough for lines.
constexpr std::array<const char*, 6> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#000000"};

/// One axis: numbers from low to high, whole powers of ten, along pixels from start to end.
struct Axis {
  double low, high;
  double start, end;

  double at(double value) const { return start + (end - start) * std::log10(value / low) / std::log10(high / low); }
};

Axis axisOver(const Plot& plot, bool isX, double start, double end) {
  double low = 1e300, high = 0;
  for (const Curve& curve : plot.curves)
    for (const auto& [x, y] : curve.points) {
      low = std::min(low, isX ? x : y);
      high = std::max(high, isX ? x : y);
    }
  return {std::pow(10, std::floor(std::log10(low))), std::pow(10, std::ceil(std::log10(high))), start, end};
}

std::string label(double x, double y, const std::string& text, const std::string& more = "") {
  std::ostringstream svg;
  svg << "<text x=\"" << x << "\" y=\"" << y << "\" " << more << ">" << reference::xmlText(text) << "</text>\n";
  return svg.str();
}

std::string line(double x0, double y0, double x1, double y1, const std::string& color) {
  std::ostringstream svg;
  svg << "<line x1=\"" << x0 << "\" y1=\"" << y0 << "\" x2=\"" << x1 << "\" y2=\"" << y1 << "\" stroke=\"" << color
      << "\"/>\n";
  return svg.str();
}

std::string power(double value) {
  std::ostringstream text;
  if (value < 1e6)
    text << value;
  else
    text << "10^" << std::lround(std::log10(value));
  return text.str();
}

std::string axes(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (double value = x.low; value < 1.1 * x.high; value *= 10) {
    svg += line(x.at(value), y.start, x.at(value), y.end, "#ddd");
    svg += label(x.at(value), y.start + 18, power(value), "text-anchor=\"middle\"");
  }
  for (double value = y.low; value < 1.1 * y.high; value *= 10) {
    svg += line(x.start, y.at(value), x.end, y.at(value), "#ddd");
    svg += label(x.start - 8, y.at(value) + 4, power(value), "text-anchor=\"end\"");
  }
  svg += label((x.start + x.end) / 2, height - 14, plot.x, "text-anchor=\"middle\"");
  std::ostringstream turned;
  turned << "text-anchor=\"middle\" transform=\"rotate(-90 18 " << (y.start + y.end) / 2 << ")\"";
  svg += label(18, (y.start + y.end) / 2, plot.y, turned.str());
  return svg + label(left, 22, plot.title, "font-weight=\"bold\"");
}

std::string polyline(const Curve& curve, const Axis& x, const Axis& y, const std::string& color) {
  std::ostringstream svg;
  svg << "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" << color << "\""
      << (curve.isDashed ? " stroke-dasharray=\"6 4\"" : "") << " points=\"";
  for (const auto& [atX, atY] : curve.points) svg << x.at(atX) << ',' << y.at(atY) << ' ';
  svg << "\"/>\n";
  for (const auto& [atX, atY] : curve.points)
    svg << "<circle r=\"3\" cx=\"" << x.at(atX) << "\" cy=\"" << y.at(atY) << "\" fill=\"" << color << "\"/>\n";
  return svg.str();
}

/// Where names stand: as near to the ends of their curves as they can without covering each other.
std::vector<double> nameHeights(const Plot& plot, const Axis& y) {
  std::vector<std::pair<double, std::size_t>> wanted;
  for (std::size_t c = 0; c < plot.curves.size(); ++c)
    wanted.emplace_back(y.at(plot.curves[c].points.back().second), c);
  std::sort(wanted.begin(), wanted.end());
  std::vector<double> heights(plot.curves.size());
  double next = top;
  for (const auto& [at, curve] : wanted) {
    heights[curve] = std::max(at, next);
    next = heights[curve] + lineHeight;
  }
  return heights;
}

}  // namespace

std::string svgOf(const Plot& plot) {
  const Axis x = axisOver(plot, true, left, width - right), y = axisOver(plot, false, height - bottom, top);
  std::ostringstream svg;
  svg << std::setprecision(6) << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\""
      << height << "\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      << axes(plot, x, y);
  const std::vector<double> heights = nameHeights(plot, y);
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const std::string color = colors[c % colors.size()];
    svg << polyline(plot.curves[c], x, y, color)
        << label(x.end + 10, heights[c] + 4, plot.curves[c].name, "fill=\"" + color + "\"");
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace hemitex::cli
