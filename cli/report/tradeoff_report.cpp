#include "cli/report/tradeoff_report.h"

#include <algorithm>
#include <array>
#include <boost/algorithm/string.hpp>
#include <sstream>

#include "cli/common/base64.h"
#include "cli/common/json.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/images/image.h"
#include "radiosity/pictures/picture_exposure.h"
#include "radiosity/pictures/pictures.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
using reference::TradeMeasurement;

ordered_json toJson(const reference::RowError& error) {
  return {{"relative_l1", error.relativeL1}, {"rms", error.rms}, {"maximum", error.maximum}};
}

ordered_json toJson(const reference::RadiosityError& error) {
  return {{"flux_weighted", error.fluxWeighted}, {"rms", error.rms}, {"maximum", error.maximum}};
}

ordered_json toJson(const Tradeoff& tradeoff, const TradeMeasurement& measurement) {
  const reference::TradeChoice& choice = measurement.choice;
  const reference::TradeMethod& method = tradeoff.methods[choice.method];
  return {
      {"method", method.name},
      {"setting", method.setting},
      {"value", choice.setting},
      {"directions", method.directions(choice.setting)},
      {"texels", choice.texels},
      {"patch", choice.patch},
      {"elements", measurement.elements},
      {"patches", measurement.patches},
      {"rows", measurement.rows},
      {"shots", measurement.shots},
      {"row_error", toJson(measurement.rowError)},
      {"radiosity_error", toJson(measurement.error)},
      {"bytes",
       {{"buffer", measurement.bufferBytes}, {"rows", measurement.rowBytes}, {"elements", measurement.elementBytes}}},
      {"times",
       {{"median_s", measurement.seconds.median},
        {"rounds_s", measurement.seconds.repetitions},
        {"pareto", measurement.isOnFront}}}};
}

ordered_json toJson(const std::vector<reference::RowQuality>& qualities) {
  return listOf(qualities, [](const reference::RowQuality& quality) -> ordered_json {
    return {{"size", quality.size}, {"error", quality.error}, {"times", {{"row_s", quality.seconds}}}};
  });
}

/// The qualities of hemicubes, each with the error of rays in the same time.
ordered_json toJson(const std::vector<reference::RowQuality>& hemicubes,
                    const std::vector<reference::RowQuality>& rays) {
  ordered_json list = toJson(hemicubes);
  for (std::size_t i = 0; i < hemicubes.size(); ++i)
    list[i]["times"]["error_of_rays"] = orNull(reference::errorAtTime(rays, hemicubes[i].seconds));
  return list;
}

ordered_json toJson(const reference::RowComparison& comparison) {
  return {{"points", comparison.patches.size()},
          {"truth_error", comparison.truthError},
          {"hemicubes", toJson(comparison.hemicubes, comparison.rays)},
          {"turned_hemicubes", toJson(comparison.turnedHemicubes, comparison.rays)},
          {"rays", toJson(comparison.rays)}};
}

/// The bounds on the error of the table of fastest choices.
constexpr double errorLevels[] = {0.1, 0.05, 0.03, 0.02, 0.01};

/// The fastest choice with at most this error; nothing if every choice has a larger error.
std::optional<std::size_t> fastestWithin(const Tradeoff& tradeoff, double error) {
  std::optional<std::size_t> fastest;
  for (std::size_t i = 0; i < tradeoff.measurements.size(); ++i) {
    const TradeMeasurement& measurement = tradeoff.measurements[i];
    if (measurement.error.fluxWeighted > error) continue;
    if (!fastest || measurement.seconds.median < tradeoff.measurements[*fastest].seconds.median) fastest = i;
  }
  return fastest;
}

/// An sRGB-encoded colour of the legend.
using Colour = std::array<int, 3>;

/// Upper ends of the bands of relative errors, and the colours of all bands from much too dark to much too bright.
constexpr std::array<double, 5> bandEnds{0.003, 0.01, 0.03, 0.1, 0.3};
constexpr std::array<Colour, 11> bandColours{{{10, 40, 100},
                                              {40, 100, 175},
                                              {90, 160, 210},
                                              {160, 203, 230},
                                              {215, 232, 245},
                                              {247, 247, 247},
                                              {253, 228, 205},
                                              {250, 190, 145},
                                              {235, 130, 90},
                                              {200, 60, 50},
                                              {120, 10, 30}}};

glm::dvec3 falseColour(const glm::dvec3& found, const glm::dvec3& truth) {
  const double whole = radiosity::bandSum(truth), difference = radiosity::bandSum(found) - whole;
  const auto band =
      std::count_if(bandEnds.begin(), bandEnds.end(), [&](double end) { return std::abs(difference) > end * whole; });
  const Colour& colour = *(bandColours.begin() + bandEnds.size() + (difference > 0 ? band : -band));
  return {radiosity::decodeSrgb(colour[0] / 255.0), radiosity::decodeSrgb(colour[1] / 255.0),
          radiosity::decodeSrgb(colour[2] / 255.0)};
}

constexpr int pictureWidth = 480, pictureHeight = 360;

std::vector<glm::dvec3> exposedTruth(const Tradeoff& tradeoff, const radiosity::Camera& camera) {
  std::vector<glm::dvec3> colours = tradeoff.truth.radiosity;
  const double exposure = radiosity::pictureExposure(tradeoff.scene, tradeoff.fine, radiosity::valuesIn(colours),
                                                     camera, pictureWidth, pictureHeight);
  for (glm::dvec3& colour : colours) colour *= exposure;
  return colours;
}

std::vector<glm::dvec3> falseColours(const Tradeoff& tradeoff, const TradeMeasurement& measurement) {
  const radiosity::Discretization own =
      radiosity::discretize(tradeoff.scene, {.texels = measurement.choice.texels, .patch = measurement.choice.patch});
  const std::vector<glm::dvec3> found = reference::onOtherGrids(own, measurement.radiosity, tradeoff.fine);
  std::vector<glm::dvec3> colours;
  for (std::size_t e = 0; e < found.size(); ++e) colours.push_back(falseColour(found[e], tradeoff.truth.radiosity[e]));
  return colours;
}

/// The choices on the Pareto front, by ascending time.
std::vector<std::size_t> front(const Tradeoff& tradeoff) {
  std::vector<std::size_t> choices;
  for (std::size_t i = 0; i < tradeoff.measurements.size(); ++i)
    if (tradeoff.measurements[i].isOnFront) choices.push_back(i);
  std::stable_sort(choices.begin(), choices.end(), [&](std::size_t a, std::size_t b) {
    return tradeoff.measurements[a].seconds.median < tradeoff.measurements[b].seconds.median;
  });
  return choices;
}

/// A list of {title, choice, png}.
ordered_json picturesOf(const Tradeoff& tradeoff, const radiosity::Camera& camera) {
  ordered_json pictures = ordered_json::array();
  const auto add = [&](const std::string& title, const std::vector<glm::dvec3>& colours, const ordered_json& choice) {
    const radiosity::Image image = radiosity::elementPicture(
        tradeoff.scene, tradeoff.fine, radiosity::valuesIn(colours), camera, pictureWidth, pictureHeight);
    const std::vector<unsigned char> png = radiosity::encodePng(radiosity::encodeSrgb(image), title);
    pictures.push_back({{"title", title}, {"choice", choice}, {"png", base64({png.begin(), png.end()})}});
  };
  add("True radiosity", exposedTruth(tradeoff, camera), {});
  const std::vector<std::size_t> choices = front(tradeoff);
  const auto addError = [&](const std::string& title, std::size_t choice) {
    add(title, falseColours(tradeoff, tradeoff.measurements[choice]), choice);
  };
  addError("Errors of the fastest choice", choices.front());
  if (choices.size() > 2) addError("Errors of the middle choice", choices[choices.size() / 2]);
  if (choices.size() > 1) addError("Errors of the most accurate choice", choices.back());
  return pictures;
}

}  // namespace

ordered_json toJson(const Tradeoff& tradeoff) {
  const auto choice = [&](const TradeMeasurement& measurement) { return toJson(tradeoff, measurement); };
  const auto within = [&](double level) -> ordered_json {
    return {{"error", level}, {"choice", orNull(fastestWithin(tradeoff, level))}};
  };
  return {{"truth",
           {{"elements", tradeoff.fine.elements.size()},
            {"radiosity_error", toJson(tradeoff.truth.error)},
            {"row_error", toJson(tradeoff.truthRowError)}}},
          {"choices", listOf(tradeoff.measurements, choice)},
          {"same_points", tradeoff.samePoints ? toJson(*tradeoff.samePoints) : ordered_json()},
          {"times", {{"within", listOf(errorLevels, within)}}}};
}

Table choiceTable(const ordered_json& choices) {
  Table table = tableOf(choices);
  const std::string columns =
      "method,setting,value,directions,texels,patch,elements,patches,rows,shots,row_relative_l1,row_rms,row_maximum,"
      "radiosity_flux_weighted,radiosity_rms,radiosity_maximum,buffer_bytes,row_bytes,element_bytes,median_s,rounds,"
      "pareto";
  boost::split(table.columns, columns, boost::is_any_of(","));
  return table;
}

std::string tradeoffText(const ordered_json& result) {
  const auto row = [&result](const ordered_json& level) {
    ordered_json cells{{"error at most", level["error"]}};
    if (level["choice"].is_null()) return cells;
    const ordered_json& choice = result["choices"][level["choice"].get<std::size_t>()];
    for (const char* key : {"method", "setting", "value", "texels", "patch"}) cells[key] = choice[key];
    cells.update({{"seconds", choice["times"]["median_s"]}, {"error", choice["radiosity_error"]["flux_weighted"]}});
    return cells;
  };
  ordered_json rows = listOf(result["times"]["within"], row);
  rows.push_back({{"error at most", "statistical error of the truth"},
                  {"error", result["truth"]["radiosity_error"]["flux_weighted"]}});
  std::ostringstream text;
  writeMarkdown(text, "Fastest choice for each bound on the error:", rows);
  return text.str();
}

std::string tradeoffPage(const Tradeoff& tradeoff, const radiosity::Camera& camera, ordered_json result) {
  result["legend"] = {{"ends", bandEnds}, {"colours", bandColours}};
  result["pictures"] = picturesOf(tradeoff, camera);
  return completePage(tradeoffPageText, result);
}

}  // namespace hemitex::cli
