#include "cli/report/solved_page.h"

#include <algorithm>
#include <numeric>

#include "cli/common/base64.h"
#include "cli/common/json.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "radiosity/textures/gltf_scene.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

/// The largest number of surfaces whose values the page holds.
constexpr std::size_t maxSurfaces = 4096;
/// The largest scene.glb that a page holds. Its base64 text is one string of a browser, which has at most 2^29 letters.
constexpr std::uintmax_t maxGlbBytes = std::uintmax_t{1} << 28;

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

/// The surfaces in each primitive of scene.glb, in the order of the file: their numbers on the page, or -1, and their
/// numbers of triangles.
ordered_json partsOf(const ShownScene& lit, const std::vector<std::uint32_t>& listed, std::size_t surfaces) {
  std::vector<std::int64_t> numbers(surfaces, -1);
  for (std::size_t i = 0; i < listed.size(); ++i) numbers[listed[i]] = static_cast<std::int64_t>(i);
  return listOf(radiosity::litParts(lit.scene), [&](const radiosity::LitPart& part) {
    return listOf(part.surfaces, [&](std::uint32_t s) {
      return ordered_json{numbers.at(lit.surfaceOf[s]), lit.scene.surfaces[s].triangles.size()};
    });
  });
}

/// A script element that a page reads by its id.
std::string dataElement(const std::string& type, const std::string& id, const std::string& text) {
  return "<script type=\"" + type + "\" id=\"" + id + "\">" + text + "</script>\n";
}

}  // namespace

std::string solvedPage(const ShownScene& lit, const ordered_json& solution) {
  const ordered_json& surfaces = solution.at("surfaces");
  const std::vector<std::uint32_t> listed = listedSurfaces(surfaces);
  std::error_code isMissing;
  const std::uintmax_t glbBytes = std::filesystem::file_size(lit.glb, isMissing);
  const bool isShown = !isMissing && glbBytes <= maxGlbBytes;

  ordered_json page;
  for (const auto& [key, value] : solution.items())
    if (key != "surfaces" && key != "times" && key != "frames") page[key] = value;
  page["room"] = {{"parts", partsOf(lit, listed, surfaces.size())},
                  {"unlisted", surfaces.size() - listed.size()},
                  {"glb", isShown     ? "shown"
                          : isMissing ? "missing"
                                      : "too large"}};
  if (!lit.version.empty()) page["version"] = lit.version;
  page["surfaces"] = listOf(listed, [&](std::uint32_t s) { return surfaceJson(surfaces[s]); });
  ordered_json times = {{"solve_s", solution.at("times").at("solve_s")}};
  if (lit.backs) {
    const std::vector<std::size_t> shots = curvePoints(lit.convergence.residual.size());
    page["convergence"] = {
        {"shots", shots},
        {"residual", listOf(shots, [&](std::size_t shot) { return lit.convergence.residual[shot - 1]; })}};
    page["backs"] = {{"absorbed_by", fluxBySurface(lit.backs->ofSurfaces, listed)},
                     {"seen_from", fluxBySurface(lit.lostToBacks, listed)},
                     {"patches", lit.backs->patches}};
    times["shots_s"] = listOf(shots, [&](std::size_t shot) { return lit.convergence.seconds[shot - 1]; });
  }
  return completePage(
      std::string("<script>") + sceneLibrary + "</script>\n" + dataElement("application/json", "times", times.dump()) +
          dataElement("model/gltf-binary", "glb", isShown ? base64OfFile(lit.glb) : "") + solvedPageText,
      page);
}

}  // namespace hemitex::cli
