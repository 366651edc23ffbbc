#include "cli/view/solved_page.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "cli/common/json.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "cli/scene/camera_options.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

/// The largest number of surfaces whose values the page holds.
constexpr std::size_t maxSurfaces = 4096;
constexpr std::uint32_t unlisted = std::numeric_limits<std::uint32_t>::max();

/// The surfaces that the page lists: the largest by area, in their order.
std::vector<std::uint32_t> listedSurfaces(const ordered_json& surfaces) {
  std::vector<std::uint32_t> numbers(surfaces.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  if (numbers.size() <= maxSurfaces) return numbers;
  std::vector<double> areas;
  for (const ordered_json& surface : surfaces) areas.push_back(surface.at("area"));
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
  numbers.resize(maxSurfaces);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// The values of a surface that the page shows; values that an older solution.json lacks are null.
ordered_json surfaceJson(const ordered_json& surface) {
  ordered_json shown;
  for (const char* key : {"name", "area", "elements", "columns", "rows", "radiosity", "reflectance", "emission"})
    shown[key] = surface.value(key, ordered_json());
  return shown;
}

/// The shots of a curve: the first hundred, then those with 1 % more shots than the one before, and the last.
std::vector<std::size_t> curvePoints(std::size_t shots) {
  std::vector<std::size_t> points;
  for (std::size_t shot = 1; shot <= shots; shot += std::max<std::size_t>(1, shot / 100)) points.push_back(shot);
  if (shots > 0 && points.back() != shots) points.push_back(shots);
  return points;
}

/// The fluxes above 0 with their surfaces, as the page lists these: `[{surface, flux}, ...]`, largest first.
ordered_json fluxBySurface(const std::vector<glm::dvec3>& flux, const std::vector<std::uint32_t>& listed) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < listed.size(); ++i)
    if (listed[i] < flux.size() && radiosity::bandSum(flux[listed[i]]) > 0) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return radiosity::bandSum(flux[listed[a]]) > radiosity::bandSum(flux[listed[b]]);
  });
  return listOf(order, [&](std::uint32_t i) {
    return ordered_json{{"surface", i}, {"flux", toJson(flux[listed[i]])}};
  });
}

/// A script element with JSON that a page reads by its id.
std::string jsonElement(const std::string& id, const ordered_json& json) {
  return "<script type=\"application/json\" id=\"" + id + "\">" + json.dump() + "</script>\n";
}

std::string scriptElement(const char* script) { return std::string("<script>") + script + "</script>\n"; }

}  // namespace

std::string solvedPage(const ShownScene& lit, const radiosity::Camera& camera, const ordered_json& solution,
                       const std::optional<SolveRecord>& record) {
  const ordered_json& surfaces = solution.at("surfaces");
  const std::vector<std::uint32_t> listed = listedSurfaces(surfaces);
  std::vector<std::uint32_t> places(surfaces.size(), unlisted);
  for (std::uint32_t i = 0; i < listed.size(); ++i) places[listed[i]] = i;
  std::vector<std::uint32_t> shownAs;
  for (const std::uint32_t surface : lit.surfaceOf) shownAs.push_back(places.at(surface));

  ordered_json page;
  for (const auto& [key, value] : solution.items())
    if (key != "surfaces" && key != "times" && key != "frames") page[key] = value;
  page["camera"] = toJson(camera);
  page["room"] = roomModel({lit.scene, lit.textures, shownAs});
  page["room"]["left_out"]["surfaces"] = surfaces.size() - listed.size();
  page["surfaces"] = listOf(listed, [&](std::uint32_t s) { return surfaceJson(surfaces[s]); });
  ordered_json times = {{"solve_s", solution.at("times").at("solve_s")}};
  if (record) {
    const std::vector<std::size_t> shots = curvePoints(record->convergence.residual.size());
    page["convergence"] = {
        {"shots", shots},
        {"residual", listOf(shots, [&](std::size_t shot) { return record->convergence.residual[shot - 1]; })}};
    page["backs"] = {{"absorbed_by", fluxBySurface(record->backs.ofSurfaces, listed)},
                     {"seen_from", fluxBySurface(record->lostToBacks, listed)},
                     {"patches", record->backs.patches}};
    times["shots_s"] = listOf(shots, [&](std::size_t shot) { return record->convergence.seconds[shot - 1]; });
  }
  return completePage(
      scriptElement(threeLibrary) + scriptElement(orbitControls) + jsonElement("times", times) + solvedPageText, page);
}

}  // namespace hemitex::cli
