#include "radiosity/gather/seen_elements.h"

#include <utility>

#include "radiosity/form_factors/scene_form_factors.h"

namespace hemitex::radiosity {

SeenElements::SeenElements(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                           BandTable radiosity, int resolution)
    : renderer_(sceneRenderer(scene, discretization, layout, ElementsBy::Texture)),
      rows_([&scene, &discretization, &layout, resolution, this] {
        return ProjectedFormFactors(scene, discretization, layout, *renderer_, {.resolution = resolution});
      }),
      sky_(lightInBands(scene, scene.outside.sky)),
      radiosity_(std::move(radiosity)) {}

std::optional<Bands> SeenElements::irradiance(const LitPlace& place) {
  constexpr double mostBacks = 0.99;  // places that see a larger share of backs are inside a solid
  std::optional<Bands> result;
  rows_.with([&](ProjectedFormFactors& rows) {
    const FormFactorRow row = rows.from(place.surface, place.point);
    if (formFactor(row.back) > mostBacks) return;
    Bands& sum = result.emplace(radiosity_.bands);
    for (std::size_t i = 0; i < row.elements.size(); ++i)
      addTo(sum, radiosity_[row.elements[i]], formFactor(row.shares[i]));
    addTo(sum, sky_, formFactor(row.background));
  });
  return result;
}

}  // namespace hemitex::radiosity
