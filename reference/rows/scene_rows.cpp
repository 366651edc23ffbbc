#include "reference/rows/scene_rows.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/rows/facet_form_factors.h"
#include "reference/truth/closed_forms/merged_pieces.h"
#include "reference/truth/closed_forms/scene_form_factors.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

namespace hemitex::reference {
namespace {

/// The numbers of the patches of each surface.
using PatchNumbers = std::vector<std::vector<std::uint32_t>>;

/// An entry of a row, or a part of it.
struct Entry {
  std::uint32_t column = 0;
  double value = 0, error = 0;
};

/// The row of the sums of entries, each in their order.
SparseRow sumOf(std::vector<Entry> entries, bool hasErrors) {
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.column < b.column; });
  SparseRow row;
  for (const Entry& entry : entries) {
    if (row.column.empty() || row.column.back() != entry.column) {
      row.column.push_back(entry.column);
      row.value.push_back(0);
      if (hasErrors) row.error.push_back(0);
    }
    row.value.back() += entry.value;
    if (hasErrors) row.error.back() += entry.error;
  }
  return row;
}

/// The column of what meets nothing; that of backs follows.
std::uint32_t surroundingsOf(const RowReceivers& receivers) {
  return static_cast<std::uint32_t>(receivers.area.size());
}

/// Adds a row to the entries of a mean. The shares of a receiver are integers, whose sum is exact.
void addRow(std::vector<Entry>& mean, const radiosity::FormFactorRow& row, const RowReceivers& receivers,
            double weight) {
  std::vector<std::pair<std::uint32_t, std::uint64_t>> shares{{surroundingsOf(receivers), row.background},
                                                              {surroundingsOf(receivers) + 1, row.back}};
  for (std::size_t i = 0; i < row.elements.size(); ++i)
    shares.emplace_back(receivers.ofElement[row.elements[i]], row.shares[i]);
  std::sort(shares.begin(), shares.end());
  for (std::size_t i = 0; i < shares.size();) {
    const std::uint32_t column = shares[i].first;
    std::uint64_t share = 0;
    for (; i < shares.size() && shares[i].first == column; ++i) share += shares[i].second;
    mean.push_back({column, weight * radiosity::formFactor(share)});
  }
}

/// The row of a point, of an element, from its centre, or of surfaces, averaged over their patches.
SparseRow meanRow(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                  const PatchNumbers& ofSurfaces, radiosity::SceneFormFactors& drawn, const Source& source,
                  const RowReceivers& receivers) {
  std::vector<Entry> mean;
  if (source.surfaces.empty()) {
    addRow(mean, drawn.uncorrected().from(radiosity::noSurface, source.point), receivers, 1.0);
    return sumOf(std::move(mean), false);
  }
  if (source.element) {
    const auto centre = radiosity::elementCentre(scene, discretization, *source.element);
    addRow(mean, drawn.uncorrected().from(source.surfaces.front(), centre), receivers, 1.0);
    return sumOf(std::move(mean), false);
  }
  std::vector<radiosity::Patch> patches;
  for (const std::uint32_t surface : source.surfaces)
    for (const std::uint32_t patch : ofSurfaces[surface]) patches.push_back(discretization.patches.list[patch]);
  double area = 0;
  for (const radiosity::Patch& patch : patches) area += patch.area;
  constexpr std::size_t rowsAtOnce = 64;
  for (std::size_t first = 0; first < patches.size(); first += rowsAtOnce) {
    const auto some = std::span(patches).subspan(first, std::min(rowsAtOnce, patches.size() - first));
    const std::vector<radiosity::FormFactorRow> rows = drawn.rows(some);
    for (std::size_t r = 0; r < some.size(); ++r) addRow(mean, rows[r], receivers, some[r].area / area);
  }
  return sumOf(std::move(mean), false);
}

/// The ray tracer and its geometry. If surfaces are receivers, they have one texel, because fewer pieces are faster.
struct Rays {
  radiosity::Discretization receiving;
  Receivers receivers;
  RayFormFactors formFactors;
  SurfacePieces shooting;

  Rays(const radiosity::Scene& scene, const radiosity::Discretization& discretization, const RowReceivers& asked)
      : receiving(asked.ofSurface.empty() ? discretization : radiosity::discretize(scene, {.texels = 1})),
        receivers{static_cast<std::uint32_t>(asked.area.size()),
                  asked.ofSurface.empty() ? asked.ofElement : asked.ofSurface},
        formFactors(scene, receiving),
        shooting(surfacePieces(scene, discretization)) {}
};

/// The polygons of surfaces and of texels. Closed forms use whole surfaces if possible: fewer pieces with the same
/// sums.
struct Polygons {
  radiosity::Discretization whole;
  SurfacePieces ofWhole, ofTexels;
  SurfacePieces seenWhole, seenTexels;  ///< with images

  Polygons(const radiosity::Scene& scene, const radiosity::Discretization& discretization)
      : whole(radiosity::discretize(scene, {.texels = 1})),
        ofWhole(mergedPieces(surfacePieces(scene, whole))),
        ofTexels(mergedPieces(surfacePieces(scene, discretization))),
        seenWhole(withImages(ofWhole, scene)),
        seenTexels(withImages(ofTexels, scene)) {}
};

/// Rows of facets, computed in blocks by all threads.
class FacetRows {
 public:
  FacetRows(const radiosity::Scene& scene, double maxError, std::size_t blockLength)
      : count_(scene.surfaces.size()), blockLength_(blockLength), factors_(scene, {maxError}) {}

  const SparseRow& row(std::uint32_t facet) {
    if (facet < first_ || facet >= first_ + rows_.size()) {
      first_ = facet;
      rows_.resize(std::min(blockLength_, count_ - facet));
      raster::parallelFor(rows_.size(),
                          [&](std::size_t i) { rows_[i] = factors_.row(first_ + static_cast<std::uint32_t>(i)); });
    }
    return rows_[facet - first_];
  }

 private:
  std::size_t count_;  ///< of facets
  std::size_t blockLength_;
  FacetFormFactors factors_;
  std::uint32_t first_ = 0;  ///< of the block
  std::vector<SparseRow> rows_;
};

std::vector<std::uint32_t> elementsOf(const radiosity::Discretization& discretization, const Source& source) {
  if (source.element) return {*source.element};
  std::vector<std::uint32_t> elements;
  for (const std::uint32_t surface : source.surfaces) {
    const std::vector<std::uint32_t> own = elementsOfSurface(discretization, surface);
    elements.insert(elements.end(), own.begin(), own.end());
  }
  return elements;
}

}  // namespace

Source texelSource(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const std::string& name, int column, int row) {
  const std::vector<std::uint32_t> surfaces = radiosity::surfacesNamed(scene, name);
  if (surfaces.size() > 1)
    throw raster::InputError(
        "`" + raster::excerpt(name) + "` has " + std::to_string(surfaces.size()) + " parts",
        "give the name of the part with the texel: `" + raster::excerpt(scene.surfaces[surfaces[0]].name) + "`, ...");
  const radiosity::Grid& grid = discretization.grids[surfaces[0]];
  const std::string texel = std::to_string(column) + "," + std::to_string(row);
  if (column < 0 || column >= grid.columns || row < 0 || row >= grid.rows)
    throw raster::InputError("`" + raster::excerpt(name) + "` has no texel " + texel,
                             "its grid has " + std::to_string(grid.columns) + " columns and " +
                                 std::to_string(grid.rows) + " rows, numbered from 0");
  const auto index =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
  if (!grid.covered[index])
    throw raster::InputError("texel " + texel + " of `" + raster::excerpt(name) +
                             "` lies outside the surface; choose another texel");
  return {surfaces, grid.elementOfTexel[index]};
}

RowReceivers elementsAsReceivers(const radiosity::Discretization& discretization) {
  RowReceivers receivers{std::vector<std::uint32_t>(discretization.elements.size()), {}, {}};
  std::iota(receivers.ofElement.begin(), receivers.ofElement.end(), 0U);
  for (const radiosity::Element& element : discretization.elements) receivers.area.push_back(element.area);
  return receivers;
}

RowReceivers familiesAsReceivers(const radiosity::Discretization& discretization, const radiosity::Families& families) {
  RowReceivers receivers{{}, families.ofSurface, std::vector<double>(families.names.size(), 0.0)};
  for (const radiosity::Element& element : discretization.elements) {
    receivers.ofElement.push_back(families.ofSurface[element.surface]);
    receivers.area[receivers.ofElement.back()] += element.area;
  }
  return receivers;
}

RowMethod drawnMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const RowReceivers& receivers, radiosity::IdLayout layout,
                      const radiosity::DrawingSettings& settings, const radiosity::RendererFactory& makeRenderer) {
  const auto split = std::make_shared<radiosity::Discretization>(discretization);
  const auto drawn =
      std::make_shared<radiosity::SceneFormFactors>(scene, *split, std::move(layout), settings, makeRenderer);
  split->patches = radiosity::splitAll(std::move(split->patches), drawn->splits());
  const auto patches =
      std::make_shared<PatchNumbers>(radiosity::patchesOfSurfaces(split->patches, split->grids.size()));
  const auto row = [&scene, &receivers, split, drawn, patches](const Source& source) {
    return meanRow(scene, *split, *patches, *drawn, source, receivers);
  };
  return {row, radiosity::formFactor(drawn->uncorrected().projection().captured)};
}

RowMethod facetMethod(const radiosity::Scene& scene, const RowReceivers& receivers, double maxError,
                      std::size_t blockLength) {
  const auto rows = std::make_shared<FacetRows>(scene, maxError, blockLength);
  return {[&receivers, rows](const Source& source) {
    const SparseRow& found = rows->row(source.surfaces.front());
    const auto surfaces = static_cast<std::uint32_t>(receivers.ofSurface.size());
    std::vector<Entry> entries;
    for (std::size_t k = 0; k < found.column.size(); ++k) {
      const std::uint32_t c = found.column[k];
      entries.push_back({c < surfaces ? receivers.ofSurface[c] : surroundingsOf(receivers) + (c - surfaces),
                         found.value[k], found.error[k]});
    }
    SparseRow row = sumOf(std::move(entries), true);
    row.rowError = found.rowError;
    return row;
  }};
}

RowMethod rayMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                    const RowReceivers& receivers, const RayOptions& options) {
  const auto rays = std::make_shared<Rays>(scene, discretization, receivers);
  return {[&discretization, rays, options](const Source& source) {
    const RaySource shooter = areaRaySource(rays->shooting, elementsOf(discretization, source));
    const auto measure = options.aimed ? &RayFormFactors::aimed : &RayFormFactors::overHemisphere;
    MeasuredRow measured =
        (rays->formFactors.*measure)(shooter, rays->receivers, {.samples = options.samples, .seed = options.seed});
    const std::size_t seen = measured.receivers.size();
    measured.receivers.insert(measured.receivers.end(), {measured.background, measured.back});
    SparseRow row;
    for (std::size_t r = 0; r < measured.receivers.size(); ++r) {
      const Measurement& receiver = measured.receivers[r];
      if (r < seen && receiver.value == 0 && receiver.standardError == 0) continue;
      row.column.push_back(static_cast<std::uint32_t>(r));
      row.value.push_back(receiver.value);
      row.error.push_back(receiver.standardError);
    }
    return row;
  }};
}

RowMethod analyticMethod(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                         const RowReceivers& receivers) {
  const auto polygons = std::make_shared<Polygons>(scene, discretization);
  return {[&discretization, &receivers, polygons](const Source& source) {
    const bool areElements = receivers.ofSurface.empty();
    const std::vector<double> values =
        analyticRow(source.element ? polygons->ofTexels : polygons->ofWhole,
                    elementsOf(source.element ? discretization : polygons->whole, source),
                    areElements ? polygons->seenTexels : polygons->seenWhole);
    const std::vector<std::uint32_t>& receiverOf = areElements ? receivers.ofElement : receivers.ofSurface;
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] != 0) entries.push_back({receiverOf[i], values[i]});
    return sumOf(std::move(entries), false);
  }};
}

}  // namespace hemitex::reference
