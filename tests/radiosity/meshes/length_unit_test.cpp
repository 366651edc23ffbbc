/// The unit of lengths that comments of OBJ files state, and what hemitex solve does with it.
#include "radiosity/meshes/length_unit.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/support/shell.h"

using namespace hemitex;
using Catch::Contains;
using radiosity::statedMetresPerUnit;

namespace {

/// What a comment states: metres per unit, 0 for nothing, -1 for a warning.
double statedBy(const std::string& text) {
  std::vector<std::string> warnings;
  const std::optional<double> metres = statedMetresPerUnit(std::string_view(text), warnings);
  CHECK((!metres || warnings.empty()));
  return warnings.empty() ? metres.value_or(0) : -1;
}

}  // namespace

TEST_CASE("statedMetresPerUnit reads the comments of exporters", "[obj]") {
  const auto [comment, metres] = GENERATE(table<std::string, double>({
      {"# File units = meters", 1.0},
      {"# File units = inches", 0.0254},
      {"# This file uses centimeters as units for non-parametric coordinates.", 0.01},
      {"# units: mm", 0.001},
      {"#Units: millimeters", 0.001},
      {"# UNITS=FEET", 0.3048},
      {"# Unit: 1 mm", 0.001},
      {"# 1 unit = 1 cm", 0.01},
      {"# units: in", 0.0254},
      {"# Units in meters", 1.0},
      {"# unit scale: kilometres", 1000.0},
      {"# 3ds Max Wavefront OBJ Exporter v0.97b - (c)2007 guruware", 0.0},
      {"# unit cube in a room", 0.0},
      {"# 3 units of furniture", 0.0},
      {"# room of 4 m", 0.0},
      {"# 1 unit = 2.54 cm", -1.0},
      {"# 1 unit = .5 m", -1.0},
      {"# units: mm or cm", -1.0},
  }));
  INFO(comment);
  CHECK(statedBy(comment) == metres);
  CHECK(statedBy("# a\r\n" + comment + "\r\nmtllib a.mtl\r\nv 0 0 0") == metres);
  CHECK(statedBy("v 0 0 0\n" + comment) == 0);
}

TEST_CASE("statedMetresPerUnit uses comments that agree, and warns of others", "[obj]") {
  CHECK(statedBy("# units: mm\n# File units = millimeters\n") == 0.001);
  CHECK(statedBy("# units: mm\n# File units = meters\n") == -1);
}

TEST_CASE("solve uses the unit that a comment of the scene states, unless an option states it", "[cli]") {
  const tests::Shell shell;
  const std::string room = tests::readAll(shell.file("room.obj"));
  const std::string quick = " --texels 2 --resolution 16 --size 16x16 --no-textures -o ";
  tests::writeAll(shell.file("room.obj"), "# File units = millimeters\n" + room);
  CHECK_THAT(shell.output("solve room.obj" + quick + "a"), Contains("lengths are in units of 0.001 m"));
  shell.output("solve room.obj --units mm" + quick + "b");
  shell.output("solve room.obj --units m" + quick + "c");
  const auto watts = [&](const std::string& folder) {
    return nlohmann::json::parse(tests::readAll(shell.file(folder + "/solution.json")))["energy"]["emitted"][0]
        .get<double>();
  };
  CHECK(watts("a") == watts("b"));
  CHECK(watts("a") == Approx(1e-6 * watts("c")));
}
