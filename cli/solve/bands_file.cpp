#include "cli/solve/bands_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "cli/common/numbers.h"
#include "radiosity/base/name_suggestions.h"
#include "radiosity/base/text_lines.h"
#include "radiosity/scene/mtl_file.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

using json = nlohmann::ordered_json;
using radiosity::Spectrum;
using raster::excerpt;
using raster::InputError;

const std::string jsonForm =
    R"(write {"wavelengths": [450, ...], "materials": {"NAME": {"reflectance": [...], "emission": [...]}}})";
const std::string csvForm = "write `material,quantity,450,...`, then lines such as `white,reflectance,0.7,...`";

/// Collects the content of a file, whose form is checked here.
class BandsReader {
 public:
  BandsReader(const std::filesystem::path& file, const radiosity::Scene& scene,
              const radiosity::SceneSettings& settings)
      : file_(file), settings_(settings), read_{{{}, radiosity::spectraOfFiles(scene, settings)}, {file}} {
    for (const radiosity::Material& material : scene.materials) names_.insert(material.name);
  }

  [[noreturn]] void fail(int line, const std::string& what, const std::string& advice = {}) const {
    throw InputError(file_.string(), line, what, advice);
  }

  void setWavelengths(int line, std::vector<double> wavelengths) {
    constexpr std::size_t maxBands = 1000;
    if (wavelengths.empty()) fail(line, "there is no wavelength");
    if (wavelengths.size() > maxBands) fail(line, "there are more than 1000 wavelengths");
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
      const std::string text = "the wavelength " + toText(wavelengths[i]);
      if (!(wavelengths[i] > 0)) fail(line, text + " is not above 0", "give wavelengths in nm");
      if (i > 0 && wavelengths[i] <= wavelengths[i - 1])
        fail(line, text + " is not above the one before", "sort the bands by wavelength");
    }
    read_.bands.wavelengths = std::move(wavelengths);
  }
  std::size_t bands() const { return read_.bands.wavelengths.size(); }

  /// Sets the values of a quantity at all wavelengths.
  void set(int line, const std::string& material, const std::string& quantity, std::vector<double> values) {
    const std::string owner = "`" + quantity + "` of `" + excerpt(material) + "`";
    if (values.size() != bands())
      fail(line, owner + " has " + std::to_string(values.size()) + " values for " + std::to_string(bands()) + " bands",
           "give one value per wavelength");
    setSpectrum(line, material, quantity, {read_.bands.wavelengths, std::move(values)});
  }

  void setSpectrum(int line, const std::string& material, const std::string& quantity, Spectrum spectrum) {
    const std::string owner = "`" + quantity + "` of `" + excerpt(material) + "`";
    if (!names_.contains(material))
      fail(line, "the scene has no material `" + excerpt(material) + "`",
           "similar names: " + radiosity::nearestNames(names_, material));
    const bool isReflectance = quantity == "reflectance";
    if (!isReflectance && quantity != "emission")
      fail(line, "`" + excerpt(quantity) + "` is no quantity", "the quantities are reflectance and emission");
    if (!known_.insert({material, quantity}).second) fail(line, owner + " is given twice");
    for (double& value : spectrum.values) {
      if (value < 0) fail(line, owner + " is negative: " + toText(value));
      if (isReflectance && value >= 1)
        fail(line, owner + " is not below 1: " + toText(value), "a surface reflects less light than it receives");
      if (!isReflectance) value *= radiosityPerUnit(settings_.emission);
      if (value > radiosity::largestEmission) fail(line, owner + " is above 1e30", "scale the light down");
    }
    radiosity::MaterialSpectra& spectra = read_.bands.materials[material];
    (isReflectance ? spectra.reflectance : spectra.emission) = std::move(spectrum);
  }

  /// Reads a spectrum from a file that this one names.
  Spectrum spectrumOf(const std::string& name) {
    read_.files.push_back(file_.parent_path() / name);
    return radiosity::parseSpectrum(raster::readFile(read_.files.back(), "give the name of a .rfl file"),
                                    read_.files.back());
  }

  BandsFile result() && { return std::move(read_); }

 private:
  const std::filesystem::path& file_;
  const radiosity::SceneSettings& settings_;
  std::set<std::string> names_;
  std::set<std::pair<std::string, std::string>> known_;
  BandsFile read_;
};

/// The line of the first place where a JSON text has a key. The parser does not tell where values are.
int lineOf(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(json(key).dump(-1, ' ', false, json::error_handler_t::replace));
  if (at == std::string::npos) return 0;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// A JSON list of finite numbers; nothing for any other value.
std::optional<std::vector<double>> numbersOf(const json& value) {
  if (!value.is_array()) return std::nullopt;
  std::vector<double> numbers;
  for (const json& number : value) {
    if (!number.is_number()) return std::nullopt;
    numbers.push_back(number.get<double>());
  }
  return numbers;
}

void readJson(const std::string& text, const std::filesystem::path& file, BandsReader& reader) {
  const json content = reference::parseJson<json>(text, file.string());
  if (!content.is_object()) reader.fail(0, "is no JSON object", jsonForm);
  const std::set<std::string> keys = {"wavelengths", "materials"};
  for (const auto& [key, value] : content.items())
    if (!keys.contains(key))
      reader.fail(lineOf(text, key), "`" + excerpt(key) + "` is not known here",
                  "similar keys: " + radiosity::nearestNames(keys, key));
  const auto wavelengths = numbersOf(content.value("wavelengths", json()));
  const int line = lineOf(text, "wavelengths");
  if (!wavelengths) reader.fail(line, "`wavelengths` is no list of numbers", jsonForm);
  reader.setWavelengths(line, *wavelengths);
  const json materials = content.value("materials", json::object());
  if (!materials.is_object()) reader.fail(lineOf(text, "materials"), "`materials` is no JSON object", jsonForm);
  for (const auto& [name, quantities] : materials.items()) {
    const int at = lineOf(text, name);
    if (!quantities.is_object()) reader.fail(at, "`" + excerpt(name) + "` is no JSON object", jsonForm);
    for (const auto& [quantity, value] : quantities.items()) {
      if (value.is_string())
        reader.setSpectrum(at, name, quantity, reader.spectrumOf(value.get<std::string>()));
      else if (value.is_number())
        reader.set(at, name, quantity, std::vector<double>(reader.bands(), value.get<double>()));
      else if (const auto values = numbersOf(value))
        reader.set(at, name, quantity, *values);
      else
        reader.fail(at, "`" + excerpt(quantity) + "` of `" + excerpt(name) + "` is " + reference::shortText(value),
                    "write a list of numbers, one number, or the name of a .rfl file");
    }
  }
}

/// The text between commas, without blanks around it.
std::vector<std::string> fieldsOf(std::string_view line) {
  std::vector<std::string> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    const std::string_view field = line.substr(0, comma);
    const std::size_t first = std::min(field.find_first_not_of(" \t"), field.size());
    fields.emplace_back(field.substr(first, field.find_last_not_of(" \t") + 1 - first));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// The numbers of fields from the third on.
std::vector<double> numbersBehind(const std::vector<std::string>& fields, int line, const BandsReader& reader) {
  std::vector<double> numbers;
  for (std::size_t i = 2; i < fields.size(); ++i) {
    const std::optional<double> number = parseNumber(fields[i]);
    if (!number) reader.fail(line, "`" + excerpt(fields[i]) + "` is no finite number", csvForm);
    numbers.push_back(*number);
  }
  return numbers;
}

void readCsv(std::string_view text, const std::filesystem::path& file, BandsReader& reader) {
  radiosity::LineReader lines(text, file);
  while (const auto content = lines.next()) {
    const int line = content->number;
    const std::vector<std::string> fields = fieldsOf(content->text);
    const bool isHeader = fields.size() > 2 && fields[0] == "material" && fields[1] == "quantity";
    if (isHeader != (reader.bands() == 0) || fields.size() < 3)
      reader.fail(line, reader.bands() == 0 ? "is no header of bands" : "is no line of values", csvForm);
    if (isHeader)
      reader.setWavelengths(line, numbersBehind(fields, line, reader));
    else
      reader.set(line, fields[0], fields[1], numbersBehind(fields, line, reader));
  }
  if (reader.bands() == 0) reader.fail(0, "has no bands", csvForm);
}

}  // namespace

BandsFile readBands(const std::filesystem::path& file, const radiosity::Scene& scene,
                    const radiosity::SceneSettings& settings) {
  const std::string text = raster::readFile(file, "give a JSON or CSV file of bands");
  BandsReader reader(file, scene, settings);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && (text[first] == '{' || text[first] == '['))
    readJson(text, file, reader);
  else
    readCsv(text, file, reader);
  return std::move(reader).result();
}

}  // namespace hemitex::cli
