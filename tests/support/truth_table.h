/// The table that hemitex_truth writes: exposed area and flux of each surface of a scene from light tracing, with
/// standard errors.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "radiosity/scene/scene.h"
#include "tests/truth/baked_radiosity.h"

namespace hemitex::tests {

/// By surface name.
using TruthTable = std::map<std::string, tests::SurfaceFlux>;

inline constexpr const char* truthColumns =
    "surface,exposed_area,flux_r,flux_g,flux_b,exposed_area_error,flux_error_r,flux_error_g,flux_error_b";

/// A comment with the command that made it, the names of the columns, and one line per surface.
inline void writeTruthTable(std::ostream& file, const std::string& command, const radiosity::Scene& scene,
                            const tests::BakedRadiosity& baked) {
  file.precision(9);
  file << "# " << command << '\n' << truthColumns << '\n';
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const tests::SurfaceFlux& of = baked.surfaces[s];
    file << scene.surfaces[s].name << ',' << of.exposedArea << ',' << of.flux.r << ',' << of.flux.g << ',' << of.flux.b
         << ',' << of.exposedAreaError << ',' << of.fluxError.r << ',' << of.fluxError.g << ',' << of.fluxError.b
         << '\n';
  }
}

/// Throws std::runtime_error if the file is not such a table.
inline TruthTable readTruthTable(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  if (!std::getline(file, line) || line != truthColumns) throw std::runtime_error(path.string() + " is no truth table");
  TruthTable table;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string name, cell;
    std::getline(cells, name, ',');
    std::array<double, 8> value{};
    for (double& number : value) number = std::getline(cells, cell, ',') ? std::stod(cell) : 0;
    table[name] = {value[0], value[4], {value[1], value[2], value[3]}, {value[5], value[6], value[7]}};
  }
  return table;
}

}  // namespace hemitex::tests
