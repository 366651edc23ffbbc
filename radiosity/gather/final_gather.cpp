#include "radiosity/gather/final_gather.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/element_materials.h"
#include "radiosity/geometry/distance_transform.h"
#include "radiosity/spectra/colour.h"
#include "radiosity/textures/map_texels.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Texels along the side of the largest cells.
constexpr int largestCell = 16;
/// The middle of a cell is drawn if its corners differ by no more than this share of their mean.
constexpr double mostSpread = 0.5;
/// One of this number of interpolated texels is drawn, to measure the error.
constexpr std::size_t texelsPerCheck = 256;

enum class State : std::uint8_t { Unknown, Drawn, Interpolated };

/// A square of texels between four that are drawn; smaller at the end of a surface.
struct Cell {
  std::uint32_t surface = 0;
  int column = 0, row = 0, right = 0, top = 0;  ///< of its corners

  bool isTexels() const { return right - column <= 1 && top - row <= 1; }
  int middleColumn() const { return (column + right) / 2; }
  int middleRow() const { return (row + top) / 2; }
};

struct TexelNumber {
  std::uint32_t surface = 0;
  std::size_t texel = 0;
};

/// The radiosity of elements with the ambient estimate, without the emission that `direct` has.
BandTable radiosityOf(const Scene& scene, const Discretization& discretization, const Solution& solution,
                      const DirectLight& direct) {
  const ElementMaterials materials(scene, discretization);
  const Bands ambient = lightInBands(scene, solution.ambient);
  BandTable table(discretization.elements.size(), materials.bands());
  for (std::uint32_t e = 0; e < table.size(); ++e) {
    const std::uint32_t surface = discretization.elements[e].surface;
    if (!solution.radiosityInBands.empty())
      set(table[e], solution.radiosityInBands[e]);
    else
      for (int band = 0; band < 3; ++band) table[e][static_cast<std::size_t>(band)] = solution.radiosity[e][band];
    const std::span<const double> reflectance = materials.reflectance(surface, e);
    for (std::size_t band = 0; band < table.bands; ++band) table[e][band] += reflectance[band] * ambient[band];
    if (direct.hasEmissionOf(surface)) addTo(table[e], materials.emission(surface, e), -1);
  }
  return table;
}

/// Light that texels see in elements: draws some of them and interpolates the others.
class Interpolation {
 public:
  Interpolation(SeenElements& seen, std::vector<LitTexels>& all, const GatherSettings& settings,
                const GatherProgress& progress)
      : seen_(seen), all_(all), settings_(settings), progress_(progress) {
    for (const LitTexels& texels : all) states_.emplace_back(texels.places.size());
  }

  void run() {
    std::vector<Cell> cells = largestCells();
    for (double done = 0; !cells.empty() && !progress_.isStopping(); done = 0.5 * (1 + done)) {
      if (progress_.show) progress_.show(done);
      draw(unknownIn(cells, [](const LitTexels& texels, const Cell& cell) { return cornersOf(texels, cell); }));
      std::vector<Cell> uneven, divided;
      for (const Cell& cell : cells)
        if (!cell.isTexels() && !settleByCorners(cell)) uneven.push_back(cell);
      draw(unknownIn(uneven, [this](const LitTexels& texels, const Cell& cell) {
        return spreadOf(cell) <= mostSpread ? std::vector{texels.at(cell.middleColumn(), cell.middleRow())}
                                            : std::vector<std::size_t>();
      }));
      for (const Cell& cell : uneven)
        if (spreadOf(cell) > mostSpread || !settleByMiddle(cell)) divide(cell, divided);
      cells = std::move(divided);
    }
    measure();
  }

  std::size_t drawn() const { return drawn_; }
  /// See GatheredLight.
  double error() const { return checks_.empty() ? 0 : std::sqrt(squares_ / static_cast<double>(checks_.size())); }

 private:
  std::vector<Cell> largestCells() const {
    std::vector<Cell> cells;
    for (std::uint32_t s = 0; s < all_.size(); ++s) {
      const int lastColumn = all_[s].columns - 1, lastRow = all_[s].rows - 1;
      for (int row = 0; row == 0 || row < lastRow; row += largestCell)
        for (int column = 0; column == 0 || column < lastColumn; column += largestCell)
          cells.push_back(
              {s, column, row, std::min(column + largestCell, lastColumn), std::min(row + largestCell, lastRow)});
    }
    return cells;
  }

  static std::array<std::size_t, 4> cornersOf(const LitTexels& texels, const Cell& cell) {
    return {texels.at(cell.column, cell.row), texels.at(cell.right, cell.row), texels.at(cell.column, cell.top),
            texels.at(cell.right, cell.top)};
  }

  /// The texels of cells that are not drawn yet.
  template <typename TexelsOfCell>
  std::vector<TexelNumber> unknownIn(const std::vector<Cell>& cells, const TexelsOfCell& texelsOf) {
    std::vector<TexelNumber> unknown;
    for (const Cell& cell : cells) {
      const LitTexels& texels = all_[cell.surface];
      for (const std::size_t texel : texelsOf(texels, cell)) {
        State& state = states_[cell.surface][texel];
        if (!texels.places[texel] || state == State::Drawn) continue;
        state = State::Drawn;
        unknown.push_back({cell.surface, texel});
      }
    }
    return unknown;
  }

  void draw(const std::vector<TexelNumber>& numbers) {
    drawn_ += numbers.size();
    raster::parallelFor(numbers.size(), [&](std::size_t i) {
      if (progress_.isStopping()) return;
      LitTexels& texels = all_[numbers[i].surface];
      std::optional<LitPlace>& place = texels.places[numbers[i].texel];
      if (const auto light = seen_.irradiance(*place)) {
        set(texels.seen[numbers[i].texel], *light);
      } else {
        place.reset();
        set(texels.direct[numbers[i].texel], Bands(texels.direct.bands));
      }
    });
  }

  static void divide(const Cell& cell, std::vector<Cell>& divided) {
    const int column = cell.middleColumn(), row = cell.middleRow();
    const std::array<std::pair<int, int>, 2> across{std::pair(cell.column, column), std::pair(column, cell.right)},
        up{std::pair(cell.row, row), std::pair(row, cell.top)};
    for (const auto& [low, high] : up)
      for (const auto& [left, right] : across)
        if ((left < right || cell.column == cell.right) && (low < high || cell.row == cell.top))
          divided.push_back({cell.surface, left, low, right, high});
  }

  static bool hasEdge(const LitTexels& texels, const Cell& cell) {
    if (texels.isBeforeEdge.empty()) return false;
    for (int row = cell.row; row <= cell.top; ++row)
      for (int column = cell.column; column <= cell.right; ++column)
        if (texels.isBeforeEdge[texels.at(column, row)]) return true;
    return false;
  }

  /// The difference of the corners of a cell over the mean of all their light; infinite if one has no area, and across
  /// an edge.
  double spreadOf(const Cell& cell) const {
    const LitTexels& texels = all_[cell.surface];
    if (hasEdge(texels, cell)) return std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity(), most = 0, sum = 0;
    for (const std::size_t texel : cornersOf(texels, cell)) {
      if (!texels.places[texel]) return std::numeric_limits<double>::infinity();
      const double light = bandSum(texels.seen[texel]), all = texels.light(texel);
      least = std::min(least, light);
      most = std::max(most, light);
      sum += all;
    }
    return sum > 0 ? 4 * (most - least) / sum : 0;
  }

  /// Interpolates a cell if its corners are nearly equal; returns whether.
  bool settleByCorners(const Cell& cell) {
    if (!(spreadOf(cell) <= settings_.even)) return false;
    interpolate(cell, Bands(all_[cell.surface].seen.bands));
    return true;
  }

  /// Interpolates a cell if its middle has about the light between the corners; returns whether.
  bool settleByMiddle(const Cell& cell) {
    const LitTexels& texels = all_[cell.surface];
    const std::size_t middle = texels.at(cell.middleColumn(), cell.middleRow());
    if (!texels.places[middle]) return false;
    Bands more(texels.seen[middle].begin(), texels.seen[middle].end());
    addTo(more, interpolated(texels, cell, cell.middleColumn(), cell.middleRow()), -1);
    if (std::abs(bandSum(more)) > settings_.tolerance * texels.light(middle)) return false;
    interpolate(cell, more);
    return true;
  }

  Bands interpolated(const LitTexels& texels, const Cell& cell, int column, int row) const {
    const glm::dvec2 at = placeIn(cell, column, row);
    const std::array<double, 4> weights{(1 - at.x) * (1 - at.y), at.x * (1 - at.y), (1 - at.x) * at.y, at.x * at.y};
    const std::array<std::size_t, 4> corners = cornersOf(texels, cell);
    Bands sum(texels.seen.bands);
    for (std::size_t k = 0; k < 4; ++k) addTo(sum, texels.seen[corners[k]], weights[k]);
    return sum;
  }

  /// In [0, 1]^2.
  static glm::dvec2 placeIn(const Cell& cell, int column, int row) {
    return {cell.right > cell.column ? (column - cell.column) / double(cell.right - cell.column) : 0,
            cell.top > cell.row ? (row - cell.row) / double(cell.top - cell.row) : 0};
  }

  /// Between the corners of a cell and its middle, which has `more` light than they have there.
  void interpolate(const Cell& cell, const Bands& more) {
    LitTexels& texels = all_[cell.surface];
    const auto hat = [](double x, double middle) {
      return middle <= 0 || middle >= 1 ? 1 : std::min(x / middle, (1 - x) / (1 - middle));
    };
    const glm::dvec2 middle = placeIn(cell, cell.middleColumn(), cell.middleRow());
    for (int row = cell.row; row <= cell.top; ++row)
      for (int column = cell.column; column <= cell.right; ++column) {
        const std::size_t texel = texels.at(column, row);
        State& state = states_[cell.surface][texel];
        if (state == State::Drawn || !texels.places[texel]) continue;
        if (state == State::Unknown && interpolated_++ % texelsPerCheck == 0) checks_.push_back({cell.surface, texel});
        state = State::Interpolated;
        const glm::dvec2 at = placeIn(cell, column, row);
        Bands light = interpolated(texels, cell, column, row);
        addTo(light, more, hat(at.x, middle.x) * hat(at.y, middle.y));
        set(texels.seen[texel], light);
      }
  }

  /// Draws some interpolated texels.
  void measure() {
    std::vector<double> squares(checks_.size());
    raster::parallelFor(checks_.size(), [&](std::size_t i) {
      if (progress_.isStopping()) return;
      const LitTexels& texels = all_[checks_[i].surface];
      const double seen = bandSum(seen_.irradiance(*texels.places[checks_[i].texel]).value_or(Bands()));
      const double difference = bandSum(texels.seen[checks_[i].texel]) - seen;
      const double light = bandSum(texels.direct[checks_[i].texel]) + seen;
      squares[i] = light > 0 ? difference * difference / (light * light) : 0;
    });
    for (const double square : squares) squares_ += square;
    drawn_ += checks_.size();
  }

  SeenElements& seen_;
  std::vector<LitTexels>& all_;
  const GatherSettings& settings_;
  const GatherProgress& progress_;
  std::vector<std::vector<State>> states_;  ///< of the texels of each surface
  std::size_t drawn_ = 0, interpolated_ = 0;
  std::vector<TexelNumber> checks_;
  double squares_ = 0;
};

}  // namespace

Magnifications magnificationsOf(const TextureLayout& textures) {
  Magnifications magnifications;
  for (const TexturePlace& place : textures.places)
    magnifications.push_back(textures.textures[static_cast<std::size_t>(place.texture)].magnification);
  return magnifications;
}

Gatherer::Gatherer(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                   const TextureLayout& textures, const Solution& solution, const GatherSettings& settings,
                   const GatherProgress& progress)
    : scene_(scene),
      discretization_(discretization),
      settings_(settings),
      progress_(progress),
      materials_(scene, discretization),
      colours_(scene.wavelengths),
      direct_(scene, discretization),
      seen_(std::make_unique<SeenElements>(
          scene, discretization, layout, radiosityOf(scene, discretization, solution, direct_), settings.resolution)) {
  const Magnifications finer = finerElements(magnificationsOf(textures));
  if (std::all_of(finer.begin(), finer.end(), [](int m) { return m == 1; })) return;
  std::vector<LitTexels> all = texelsOf(scene, discretization, finer);
  light(all, TexelUse::Reflecting);
  finer_ = dividedFiner(finer);
  finerLayout_ = layOut(finer_);
  seen_ = std::make_unique<SeenElements>(scene, finer_, finerLayout_, radiosityOfFiner(all), settings.resolution);
}

void Gatherer::light(std::vector<LitTexels>& all, TexelUse use) {
  raster::parallelFor(all.size(), [&](std::size_t s) { addDirectLight(direct_, all[s], use, progress_.isCancelled); });
  Interpolation interpolation(*seen_, all, settings_, progress_);
  interpolation.run();
  drawn_ += interpolation.drawn();
  error_ = interpolation.error();
}

Bands Gatherer::lightAt(const LitPlace& place) {
  LitTexels texel{
      .places = {place}, .direct = BandTable(1, materials_.bands()), .seen = BandTable(1, materials_.bands())};
  addDirectLight(direct_, texel, TexelUse::Shown, nullptr);
  Bands sum = seen_->irradiance(place).value_or(Bands(materials_.bands()));
  addTo(sum, texel.direct[0]);
  return sum;
}

glm::dvec3 Gatherer::colourOf(std::uint32_t surface, std::uint32_t element, Bands light) const {
  if (scene_.wavelengths.empty()) return colours_.of(light);
  for (std::size_t band = 0; band < light.size(); ++band) light[band] *= materials_.reflectance(surface, element)[band];
  return irradianceFor(colours_.of(light), glm::dvec3(0), reflectance(scene_, discretization_, element));
}

std::vector<glm::dvec3> Gatherer::coloursOf(std::uint32_t surface, int magnification, const LitTexels& texels) const {
  const Grid& grid = discretization_.grids[surface];
  const auto columns = static_cast<std::size_t>(texels.columns), m = static_cast<std::size_t>(magnification);
  std::vector<glm::dvec3> result(texels.places.size());
  std::vector<bool> covered;
  for (std::size_t i = 0; i < result.size(); ++i) {
    covered.push_back(texels.places[i].has_value());
    const std::uint32_t element =
        grid.elementOfTexel[i / columns / m * static_cast<std::size_t>(grid.columns) + i % columns / m];
    result[i] = colourOf(surface, element, texels.allLight(i));
  }
  if (std::find(covered.begin(), covered.end(), true) == covered.end()) return result;
  const std::vector<std::uint32_t> nearest = nearestCovered(texels.columns, texels.rows, covered);
  for (std::size_t i = 0; i < result.size(); ++i)
    if (!covered[i]) result[i] = result[nearest[i]];
  return result;
}

/// How much finer the elements of surfaces become: as many as the settings ask along the longer side, but not more than
/// there are texels. While all surfaces together would have more than mostElements, half as many are asked.
Magnifications Gatherer::finerElements(const Magnifications& texels) const {
  constexpr std::size_t mostElements = std::size_t{1} << 18;
  for (int elements = settings_.elements; elements > 1; elements /= 2) {
    Magnifications finer(texels.size(), 1);
    std::size_t count = 0;
    for (std::size_t s = 0; s < finer.size(); ++s) {
      const Grid& grid = discretization_.grids[s];
      while (isDiscretized(grid) && 2 * finer[s] <= texels[s] &&
             finer[s] * std::max(grid.columns, grid.rows) < elements)
        finer[s] *= 2;
      count += static_cast<std::size_t>(grid.columns * finer[s]) * static_cast<std::size_t>(grid.rows * finer[s]);
    }
    if (count <= mostElements) return finer;
  }
  return Magnifications(texels.size(), 1);
}

/// Surfaces divided into finer elements; solids bury what they bury in the discretization.
Discretization Gatherer::dividedFiner(const Magnifications& finer) const {
  DiscretizationSettings settings{.isUnburied = true};
  for (std::size_t s = 0; s < finer.size(); ++s) {
    const Grid& grid = discretization_.grids[s];
    settings.surfaceTexels[scene_.surfaces[s].name] = {grid.columns * finer[s], grid.rows * finer[s]};
    settings.isUnburied = settings.isUnburied && grid.cutTexels.empty();
  }
  return discretize(scene_, settings);
}

/// The radiosity of finer elements, one per texel of `all`, without the emission of sources.
BandTable Gatherer::radiosityOfFiner(const std::vector<LitTexels>& all) const {
  const ElementMaterials materials(scene_, finer_);
  BandTable table(finer_.elements.size(), materials.bands());
  for (std::uint32_t e = 0; e < table.size(); ++e) {
    const auto& [area, surface, texel] = finer_.elements[e];
    const std::span<const double> reflectance = materials.reflectance(surface, e), direct = all[surface].direct[texel],
                                  seen = all[surface].seen[texel];
    for (std::size_t band = 0; band < table.bands; ++band)
      table[e][band] = reflectance[band] * (direct[band] + seen[band]);
    if (!direct_.hasEmissionOf(surface)) addTo(table[e], materials.emission(surface, e));
  }
  return table;
}

std::optional<GatheredLight> gather(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                                    const TextureLayout& textures, const Solution& solution,
                                    const GatherSettings& settings, const GatherProgress& progress) {
  const Magnifications magnifications = magnificationsOf(textures);
  Gatherer gatherer(scene, discretization, layout, textures, solution, settings, progress);
  std::vector<LitTexels> all = texelsOf(scene, discretization, magnifications);
  gatherer.light(all, TexelUse::Shown);
  if (progress.isStopping()) return std::nullopt;
  GatheredLight result{.irradiance = std::vector<std::vector<glm::dvec3>>(all.size()),
                       .drawn = gatherer.drawn(),
                       .error = gatherer.error()};
  raster::parallelFor(all.size(), [&](std::size_t s) {
    result.irradiance[s] = gatherer.coloursOf(static_cast<std::uint32_t>(s), magnifications[s], all[s]);
  });
  for (const LitTexels& texels : all)
    result.texels += static_cast<std::size_t>(
        std::count_if(texels.places.begin(), texels.places.end(), [](const auto& place) { return place.has_value(); }));
  return result;
}

std::vector<Image> irradianceTextures(const Discretization& discretization, const TextureLayout& textures,
                                      const GatheredLight& light) {
  return texturesOf(discretization, textures, [&](std::uint32_t surface) { return light.irradiance[surface]; });
}

std::vector<Image> radiosityTextures(const Scene& scene, const Discretization& discretization,
                                     const TextureLayout& textures, const GatheredLight& light) {
  const std::vector<ImageLevels> maps = levelsOfMaps(scene);
  return texturesOf(discretization, textures, [&](std::uint32_t s) {
    std::vector<glm::dvec3> texels = light.irradiance[s];
    const Surface& surface = scene.surfaces[s];
    const Grid& grid = discretization.grids[s];
    const int magnification = textures.textures[static_cast<std::size_t>(textures.places[s].texture)].magnification;
    if (hasMaps(scene, surface)) {
      applyMaps(scene, maps, surface, grid.columns * magnification, grid.rows * magnification, texels);
      return texels;
    }
    const glm::dvec3 reflected = reflectance(scene, discretization, grid.firstElement),
                     emitted = emission(scene, discretization, grid.firstElement);
    for (glm::dvec3& texel : texels) texel = emitted + reflected * texel;
    return texels;
  });
}

}  // namespace hemitex::radiosity
