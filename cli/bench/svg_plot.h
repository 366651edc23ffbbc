/// Curves on logarithmic axes, as a picture that any browser shows (SVG 1.1).
#pragma once

#include <string>
#include <vector>

namespace hemitex::cli {

struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;  ///< by ascending x; all numbers above 0
  bool isDashed = false;
};

struct Plot {
  std::string name;  ///< an item ID, for its file
  std::string title;
  std::string x, y;  ///< what the axes show, with its unit
  std::vector<Curve> curves;
};

/// Curves have colours by their order, and their names at their right ends.
std::string svgOf(const Plot& plot);

}  // namespace hemitex::cli
