#include "cli/tradeoff/page.h"

#include <algorithm>
#include <array>

#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/images/image.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/textures/radiosity_texture.h"
#include "reference/truth/solution/radiosity_error.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
using reference::TradeMeasurement;

constexpr int pictureWidth = 480, pictureHeight = 360;

/// An sRGB-encoded colour of the legend.
using Colour = std::array<int, 3>;

/// Upper ends of the bands of relative errors. The colours have one more entry, for errors beyond the last end.
constexpr std::array<double, 5> bandEnds{0.003, 0.01, 0.03, 0.1, 0.3};
constexpr std::array<Colour, 6> tooBright{
    {{247, 247, 247}, {253, 228, 205}, {250, 190, 145}, {235, 130, 90}, {200, 60, 50}, {120, 10, 30}}};
constexpr std::array<Colour, 6> tooDark{
    {{247, 247, 247}, {215, 232, 245}, {160, 203, 230}, {90, 160, 210}, {40, 100, 175}, {10, 40, 100}}};

glm::dvec3 linear(const Colour& colour) {
  return {radiosity::decodeSrgb(colour[0] / 255.0), radiosity::decodeSrgb(colour[1] / 255.0),
          radiosity::decodeSrgb(colour[2] / 255.0)};
}

glm::dvec3 falseColour(const glm::dvec3& found, const glm::dvec3& truth) {
  const double whole = radiosity::bandSum(truth), difference = radiosity::bandSum(found) - whole;
  const double size = std::abs(difference);
  const auto band = static_cast<std::size_t>(
      std::count_if(bandEnds.begin(), bandEnds.end(), [&](double end) { return size > end * whole; }));
  return linear((difference > 0 ? tooBright : tooDark)[band]);
}

/// The base64 text of a PNG file of an image.
std::string pngLetters(const radiosity::Image& image, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "picture.png";
  radiosity::writePng(file, image);
  std::string letters = base64OfFile(file);
  std::filesystem::remove(file);
  return letters;
}

class Pictures {
 public:
  Pictures(const Tradeoff& tradeoff, const radiosity::Camera& camera, const std::filesystem::path& folder)
      : tradeoff_(tradeoff), camera_(camera), folder_(folder) {}

  void add(const std::string& title, const std::vector<glm::dvec3>& colours, const ordered_json& choice) {
    const radiosity::Image image = radiosity::elementPicture(
        tradeoff_.scene, tradeoff_.fine, radiosity::valuesIn(colours), camera_, pictureWidth, pictureHeight);
    list_.push_back({{"title", title}, {"choice", choice}, {"png", pngLetters(image, folder_)}});
  }
  const ordered_json& list() const { return list_; }

 private:
  const Tradeoff& tradeoff_;
  const radiosity::Camera& camera_;
  const std::filesystem::path& folder_;
  ordered_json list_ = ordered_json::array();
};

std::vector<glm::dvec3> exposedTruth(const Tradeoff& tradeoff) {
  std::vector<glm::dvec3> colours = tradeoff.truth.radiosity;
  const double exposure = radiosity::defaultExposure(tradeoff.scene, tradeoff.fine, radiosity::valuesIn(colours));
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

ordered_json picturesOf(const Tradeoff& tradeoff, const radiosity::Camera& camera,
                        const std::filesystem::path& folder) {
  Pictures pictures(tradeoff, camera, folder);
  pictures.add("True radiosity", exposedTruth(tradeoff), {});
  const std::vector<std::size_t> choices = front(tradeoff);
  const auto addError = [&](const std::string& title, std::size_t choice) {
    pictures.add(title, falseColours(tradeoff, tradeoff.measurements[choice]), choice);
  };
  addError("Errors of the fastest choice", choices.front());
  if (choices.size() > 2) addError("Errors of the middle choice", choices[choices.size() / 2]);
  if (choices.size() > 1) addError("Errors of the most accurate choice", choices.back());
  return pictures.list();
}

/// The bands from too dark to too bright.
ordered_json legend() {
  ordered_json bands = ordered_json::array();
  for (std::size_t i = tooDark.size(); i-- > 1;) bands.push_back(tooDark[i]);
  for (const Colour& colour : tooBright) bands.push_back(colour);
  return {{"ends", bandEnds}, {"colours", std::move(bands)}};
}

}  // namespace

std::string tradeoffPage(const Tradeoff& tradeoff, const radiosity::Camera& camera, ordered_json result,
                         const std::filesystem::path& folder) {
  result["legend"] = legend();
  result["pictures"] = picturesOf(tradeoff, camera, folder);
  return completePage(tradeoffPageText, result);
}

}  // namespace hemitex::cli
