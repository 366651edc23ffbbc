/// Settings for reading a scene file and its materials.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/symmetry.h"

namespace hemitex::radiosity {

/// The source of charts.
enum class Charts {
  Auto,    ///< the file's coordinates if they form a chart; the corners of a single quad; else planar and curved parts
  File,    ///< the file's coordinates; an InputError if they do not form a chart
  Planar,  ///< always planar parts
};

/// The unit of `Ke`. Scenes hold radiosity in either case.
enum class EmissionUnit {
  Radiosity,  ///< emitted power per area, W/m^2
  Radiance,   ///< of a diffuse emitter, W/(m^2 sr): its radiosity over pi
};

/// The radiosity of one unit of emission: 1 or pi.
constexpr double radiosityPerUnit(EmissionUnit unit) { return unit == EmissionUnit::Radiance ? std::numbers::pi : 1.0; }

/// The surfaces that get a surface of their own on the back. Other backs absorb.
enum class Sides {
  One,          ///< none
  TwoOfSheets,  ///< open sheets that are lit from both sides (see open_sheets.h)
  Two,          ///< all
};

struct SceneSettings {
  Charts charts = Charts::Auto;
  /// Edges at which faces meet at a larger angle are creases; in degrees, above 0. Without it the normals of the file
  /// decide, and 40 degrees where it has none.
  std::optional<double> crease = {};
  double maxReflectance = 0.9999;  ///< a reflectance of 1 or more is lowered to this, with a warning; in [0, 1)
  Sides sides = Sides::One;
  /// Each face of the file is a surface, named by its number (see divideIntoFacets). Needs one-sided surfaces.
  bool facets = false;
  EmissionUnit emission = EmissionUnit::Radiosity;  ///< unit of Ke
  /// By which the candela and lux of a file are divided. In each band: that of green light of 555 nm, which Blender
  /// multiplies W with when it writes a file.
  double lumensPerWatt = 683;
  /// The cell data of a VTK file that are the reflectance and the emission of its faces; empty: none.
  std::string cellReflectance = {}, cellEmission = {};
  Symmetry symmetry = {};
  std::vector<std::string> flip = {};  ///< names of surfaces or families that are turned over
};

}  // namespace hemitex::radiosity
