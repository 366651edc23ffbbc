/// How an OBJ file and its materials are read.
#pragma once

#include <numbers>

namespace hemitex::radiosity {

/// Which texture coordinates become charts.
enum class Charts {
  Auto,    ///< the file's where they form a chart, a lone quad by its corners, else planar parts
  File,    ///< the file's; an InputError where they do not form a chart
  Planar,  ///< planar parts, whatever the file has
};

/// What `Ke` is a number of. The scene holds radiosity, whatever the file has.
enum class EmissionUnit {
  Radiosity,  ///< emitted power per area, W/m^2
  Radiance,   ///< of a diffuse emitter, W/(m^2 sr): its radiosity over pi
};

/// The radiosity that one unit of emission stands for: 1 or pi.
constexpr double radiosityPerUnit(EmissionUnit unit) { return unit == EmissionUnit::Radiance ? std::numbers::pi : 1.0; }

struct SceneSettings {
  Charts charts = Charts::Auto;
  double maxReflectance = 0.9999;  ///< a reflectance of 1 or more is lowered to this, with a warning; in [0, 1)
  bool twoSided = false;           ///< gives each side of every surface a surface of its own
  EmissionUnit emission = EmissionUnit::Radiosity;  ///< unit of Ke
};

}  // namespace hemitex::radiosity
