/// The light that points of surfaces see in elements: a hemicube over a point shows them as item IDs.
#pragma once

#include <memory>
#include <optional>

#include "radiosity/base/bands.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/gather/direct_light.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/base/pool.h"

namespace hemitex::radiosity {

class SeenElements {
 public:
  /// `radiosity` has the bands of each element, in W/m^2; hemicubes have `resolution` pixels along a side. The other
  /// arguments must outlive this object.
  SeenElements(const Scene& scene, const Discretization& discretization, const IdLayout& layout, BandTable radiosity,
               int resolution);

  /// The irradiance at a place in W/m^2, with that of the sky. Nothing inside solids, where places at contacts may be
  /// by rounding. Several threads may call it.
  std::optional<Bands> irradiance(const LitPlace& place);

 private:
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  raster::Pool<ProjectedFormFactors> rows_;
  Bands sky_;
  BandTable radiosity_;
};

}  // namespace hemitex::radiosity
