#include "cli/formfactors/methods.h"

#include <memory>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "reference/truth/closed_forms/scene_form_factors.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

namespace hemitex::cli {
namespace {

void addRow(Row& mean, const radiosity::FormFactorRow& row, const Receivers& receivers, double weight) {
  std::vector<std::uint64_t> share(receivers.area.size(), 0);
  for (std::size_t i = 0; i < row.elements.size(); ++i) share[receivers.ofElement[row.elements[i]]] += row.shares[i];
  for (std::size_t r = 0; r < share.size(); ++r) mean.formFactor[r] += weight * radiosity::formFactor(share[r]);
  *mean.background += weight * radiosity::formFactor(row.background);
  *mean.back += weight * radiosity::formFactor(row.back);
}

/// The row of an element, from its centre, or of surfaces, averaged over their patches.
Row meanRow(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
            radiosity::ProjectedFormFactors& rows, const Source& source, const Receivers& receivers) {
  Row mean{.formFactor = std::vector<double>(receivers.area.size(), 0.0),
           .background = 0.0,
           .back = 0.0,
           .captured = radiosity::formFactor(rows.projection().captured)};
  if (source.element) {
    const auto centre = radiosity::elementCentre(scene, discretization, *source.element);
    addRow(mean, rows.from(source.surfaces.front(), centre), receivers, 1.0);
    return mean;
  }
  const auto ofSurfaces = radiosity::patchesOfSurfaces(discretization.patches, discretization.grids.size());
  std::vector<std::uint32_t> patches;
  for (const std::uint32_t surface : source.surfaces)
    patches.insert(patches.end(), ofSurfaces[surface].begin(), ofSurfaces[surface].end());
  double area = 0;
  for (const std::uint32_t patch : patches) area += discretization.patches.list[patch].area;
  for (const std::uint32_t number : patches) {
    const radiosity::Patch& patch = discretization.patches.list[number];
    addRow(mean, rows.ofPatch(patch), receivers, patch.area / area);
  }
  return mean;
}

/// The ray tracer and its geometry. If surfaces are receivers, they have one texel, because fewer pieces are faster.
struct Rays {
  radiosity::Discretization receiving;
  reference::Receivers receivers;
  reference::RayFormFactors formFactors;
  reference::SurfacePieces shooting;

  Rays(const radiosity::Scene& scene, const radiosity::Discretization& discretization, const Receivers& asked)
      : receiving(asked.ofSurface.empty() ? discretization : radiosity::discretize(scene, {.texels = 1})),
        receivers{static_cast<std::uint32_t>(asked.area.size()),
                  asked.ofSurface.empty() ? asked.ofElement : asked.ofSurface},
        formFactors(scene, receiving),
        shooting(reference::surfacePieces(scene, discretization)) {}
};

/// The polygons of surfaces and of texels. Closed forms use whole surfaces if possible: fewer pieces with the same
/// sums.
struct Polygons {
  radiosity::Discretization whole;
  reference::SurfacePieces ofWhole, ofTexels;

  Polygons(const radiosity::Scene& scene, const radiosity::Discretization& discretization)
      : whole(radiosity::discretize(scene, {.texels = 1})),
        ofWhole(reference::surfacePieces(scene, whole)),
        ofTexels(reference::surfacePieces(scene, discretization)) {}
};

std::vector<std::uint32_t> elementsOf(const radiosity::Discretization& discretization, const Source& source) {
  if (source.element) return {*source.element};
  std::vector<std::uint32_t> elements;
  for (const std::uint32_t surface : source.surfaces) {
    const std::vector<std::uint32_t> own = reference::elementsOfSurface(discretization, surface);
    elements.insert(elements.end(), own.begin(), own.end());
  }
  return elements;
}

}  // namespace

Receivers elementsAsReceivers(const radiosity::Discretization& discretization) {
  Receivers receivers{std::vector<std::uint32_t>(discretization.elements.size()), {}, {}};
  std::iota(receivers.ofElement.begin(), receivers.ofElement.end(), 0U);
  for (const radiosity::Element& element : discretization.elements) receivers.area.push_back(element.area);
  return receivers;
}

Receivers familiesAsReceivers(const radiosity::Discretization& discretization, const Families& families) {
  Receivers receivers{{}, families.ofSurface, std::vector<double>(families.names.size(), 0.0)};
  for (const radiosity::Element& element : discretization.elements) {
    receivers.ofElement.push_back(families.ofSurface[element.surface]);
    receivers.area[receivers.ofElement.back()] += element.area;
  }
  return receivers;
}

RowMethod drawnMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const Receivers& receivers, const radiosity::IdSettings& id,
                      const radiosity::DrawingSettings& settings, Console& console) {
  const auto split = std::make_shared<radiosity::Discretization>(discretization);
  const auto drawn =
      std::make_shared<radiosity::SceneFormFactors>(scene, *split, layoutOf(id, discretization, console), settings);
  split->patches = radiosity::splitAll(std::move(split->patches), drawn->splits());
  return [&scene, &receivers, split, drawn](const Source& source) {
    return meanRow(scene, *split, drawn->rows(), source, receivers);
  };
}

RowMethod rayMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                    const Receivers& receivers, const RayOptions& options) {
  const auto rays = std::make_shared<Rays>(scene, discretization, receivers);
  return [&discretization, rays, options](const Source& source) {
    const reference::RaySource shooter = reference::areaRaySource(rays->shooting, elementsOf(discretization, source));
    const auto measure = options.aimed ? &reference::RayFormFactors::aimed : &reference::RayFormFactors::overHemisphere;
    const reference::MeasuredRow measured =
        (rays->formFactors.*measure)(shooter, rays->receivers, {.samples = options.samples, .seed = options.seed});
    Row row{.background = measured.background.value, .back = measured.back.value};
    for (const reference::Measurement& receiver : measured.receivers) {
      row.formFactor.push_back(receiver.value);
      row.standardError.push_back(receiver.standardError);
    }
    return row;
  };
}

RowMethod analyticMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                         const Receivers& receivers) {
  const auto polygons = std::make_shared<Polygons>(scene, discretization);
  return [&discretization, &receivers, polygons](const Source& source) {
    const bool areElements = receivers.ofSurface.empty();
    const std::vector<double> values =
        reference::analyticRow(source.element ? polygons->ofTexels : polygons->ofWhole,
                               elementsOf(source.element ? discretization : polygons->whole, source),
                               areElements ? polygons->ofTexels : polygons->ofWhole);
    const std::vector<std::uint32_t>& receiverOf = areElements ? receivers.ofElement : receivers.ofSurface;
    Row row{.formFactor = std::vector<double>(receivers.area.size(), 0.0)};
    for (std::size_t i = 0; i < values.size(); ++i) row.formFactor[receiverOf[i]] += values[i];
    return row;
  };
}

}  // namespace hemitex::cli
