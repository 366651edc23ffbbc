#include "radiosity/scene/materials.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "radiosity/base/named_file.h"
#include "radiosity/base/text_lines.h"
#include "radiosity/scene/mtl_file.h"
#include "radiosity/spectra/colour.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

/// A statement and its file. The paths in it are relative to the folder of the file.
struct Definition {
  MaterialStatement statement;
  std::filesystem::path file;
};

std::map<std::string, Definition> readDefinitions(const std::vector<std::filesystem::path>& files, EmissionUnit unit,
                                                  MaterialSet& set) {
  std::map<std::string, Definition> definitions;
  for (const std::filesystem::path& file : files) {
    const std::optional<std::string> text = raster::tryReadFile(file);
    if (!text) {
      set.warnings.push_back("the material file " + file.string() + " cannot be read; its materials become grey 0.5");
      continue;
    }
    set.files.push_back(file);
    for (MaterialStatement& statement : parseMaterials(*text, file, unit)) {
      definitions.try_emplace(statement.name, Definition{statement, file});
    }
  }
  return definitions;
}

template <typename Predicate>
bool anyValue(const Image& image, Predicate predicate) {
  return std::any_of(image.pixels.begin(), image.pixels.end(), [&](const glm::dvec3& pixel) {
    return predicate(pixel.r) || predicate(pixel.g) || predicate(pixel.b);
  });
}

std::uint64_t bytesOf(const Image& image) { return image.pixels.size() * sizeof image.pixels[0]; }

/// The images of maps; each file is read once.
class MapImages {
 public:
  explicit MapImages(MaterialSet& set)
      : set_(set), memory_(set.files.empty() ? std::string() : set.files.front().string(), imagesOfScene) {}

  /// The image of a map; nothing, with a warning, if it cannot be read.
  std::optional<int> emission(const MapStatement& map, const Definition& definition) {
    return withSamplerOf(map, whole(map, definition));
  }

  /// As emission, with values of at most 1.
  std::optional<int> reflectance(const MapStatement& map, const Definition& definition) {
    return withSamplerOf(map, lowered(map, definition));
  }

  /// The holes of a map_d: pixels with alpha below 0.5, or of an image without alpha, with a mean code below half of
  /// white. Nothing without holes, or with a warning as above.
  std::shared_ptr<const CutOut> cutOut(const MapStatement& map, const Definition& definition) {
    const std::optional<int> number = whole(map, definition, "");
    if (!number) {
      set_.warnings.push_back("material '" + raster::excerpt(definition.statement.name) +
                              "': without the image of its map_d it is opaque");
      return nullptr;
    }
    CutOut cutOut = cutOutOf(imageAt(*number), 1, 0.5);
    cutOut.sampler = map.sampler;
    if (!hasAlpha(*number))
      std::transform(imageAt(*number).pixels.begin(), imageAt(*number).pixels.end(), cutOut.isHole.begin(),
                     [](const glm::dvec3& pixel) { return bandSum(pixel) / 3 < decodeSrgb(0.5); });
    const bool hasHoles = std::find(cutOut.isHole.begin(), cutOut.isHole.end(), true) != cutOut.isHole.end();
    return hasHoles ? std::make_shared<CutOut>(std::move(cutOut)) : nullptr;
  }

  bool hasAlpha(int image) const { return !imageAt(image).alpha.empty(); }

 private:
  /// The image as it is in its file; `otherwise` ends the warning if there is none.
  std::optional<int> whole(const MapStatement& map, const Definition& definition,
                           const std::string& otherwise = "; 0.5 stands for it") {
    const std::string owner = "material '" + raster::excerpt(definition.statement.name) + "': ";
    if (map.image.empty()) {
      set_.warnings.push_back(owner + "a map names no image" + otherwise);
      return {};
    }
    if (!map.omitted.empty())
      set_.warnings.push_back(owner + "options of its maps are left out: " + raster::excerpt(map.omitted));
    const std::filesystem::path folder = definition.file.parent_path(),
                                file = namedFile(folder, map.image).value_or(folder / map.image);
    std::error_code ignored;
    const auto [known, isNew] = read_.try_emplace(std::filesystem::weakly_canonical(file, ignored));
    if (isNew) known->second = read(file, otherwise);
    return known->second;
  }

  std::optional<int> withSamplerOf(const MapStatement& map, const std::optional<int>& image) {
    return image ? std::optional(withSampler(set_, *image, map.sampler, variants_[*image], memory_)) : std::nullopt;
  }

  /// As whole, with values of at most 1.
  std::optional<int> lowered(const MapStatement& map, const Definition& definition) {
    const std::optional<int> image = whole(map, definition);
    if (!image || !anyValue(imageAt(*image), [](double value) { return value > 1; })) return image;
    const auto [known, isNew] = lowered_.try_emplace(*image, static_cast<int>(set_.images.size()));
    if (isNew) {
      memory_.add(bytesOf(imageAt(*image)));
      Image lowered = imageAt(*image);
      for (glm::dvec3& pixel : lowered.pixels) pixel = glm::min(pixel, glm::dvec3(1.0));
      set_.images.push_back(std::move(lowered));
      set_.warnings.push_back("material '" + definition.statement.name +
                              "': its map_Kd has values above 1; they are lowered to 1");
    }
    return known->second;
  }

  const Image& imageAt(int index) const { return set_.images[static_cast<std::size_t>(index)]; }

  std::optional<int> read(const std::filesystem::path& file, const std::string& otherwise) {
    Image image;
    try {
      image = readImage(file);
      memory_.add(bytesOf(image));
    } catch (const raster::SizeError&) {
      throw;
    } catch (const raster::InputError& error) {
      set_.warnings.push_back(error.what() + otherwise);
      return {};
    }
    if (anyValue(image, [](double value) { return value < 0; })) fail({file}, "a map with negative values");
    set_.files.push_back(file);
    set_.images.push_back(std::move(image));
    return static_cast<int>(set_.images.size()) - 1;
  }

  MaterialSet& set_;
  raster::RunningRequest memory_;
  std::map<std::filesystem::path, std::optional<int>> read_;
  std::map<int, int> lowered_;                ///< from images to their copies without values above 1
  std::map<int, std::vector<int>> variants_;  ///< see withSampler
};

/// The statement that lets light through a material; null if there is none. Exporters write both `d` and `Tr`, and some
/// give `Tr` the meaning of `d`, so that `Tr` counts only without `d`.
const char* wayThrough(const MaterialStatement& statement) {
  if (statement.dissolve) return *statement.dissolve < 1 ? "d below 1" : nullptr;
  return statement.transparency.value_or(0) > 0 ? "Tr above 0" : nullptr;
}

/// Turns the spectra of a definition into colours.
void convertSpectra(Definition& definition, MaterialSet& set) {
  MaterialStatement& statement = definition.statement;
  const auto convert = [&](const std::optional<SpectrumStatement>& from, auto colourOf, std::optional<glm::dvec3>& to) {
    if (!from) return;
    const glm::dvec3 colour = colourOf(readSpectrum(*from, definition.file));
    to = glm::max(colour, glm::dvec3(0));
    if (*to != colour)
      set.warnings.push_back("material '" + raster::excerpt(statement.name) + "': the colour of " +
                             from->spectrum.string() + " lies outside sRGB; its negative channels become 0");
    set.files.push_back(definition.file.parent_path() / from->spectrum);
  };
  convert(statement.reflectanceSpectrum, reflectanceColour, statement.reflectance);
  convert(statement.emissionSpectrum, linearSrgb, statement.emission);
  if (statement.emissionSpectrum && std::max({statement.emission->r, statement.emission->g, statement.emission->b}) >
                                        largestEmission / std::numbers::pi)
    fail({definition.file, statement.emissionSpectrum->line}, "Ke is above 1e30 / pi", "scale the light down");
}

Material makeMaterial(Definition definition, const SceneSettings& settings, MapImages& images, MaterialSet& set) {
  convertSpectra(definition, set);
  std::vector<std::string>& warnings = set.warnings;
  const MaterialStatement& statement = definition.statement;
  const std::string owner = "material '" + raster::excerpt(statement.name) + "': ";
  Material material{.name = statement.name};
  const bool isBlack = statement.reflectanceMap && statement.reflectance == glm::dvec3(0);
  if (isBlack)
    warnings.push_back(owner + "Kd 0 0 0 with a map_Kd; the map alone is the colour, as its writers mean it");
  if (statement.hasDecal) warnings.push_back(owner + "decal is left out");
  if (statement.reflectance && !isBlack) {
    material.reflectance = *statement.reflectance;
    const auto warning = lowerReflectance(material.reflectance, settings.maxReflectance);
    // With a map, 1 only says that the map is the colour.
    if (warning && !statement.reflectanceMap) warnings.push_back(owner + *warning);
  } else if (statement.reflectanceMap) {
    material.reflectance = glm::dvec3(settings.maxReflectance);
  } else {
    warnings.push_back(owner + "it has no Kd; grey 0.5 stands for it");
  }
  if (statement.reflectanceMap) {
    material.reflectanceMap = images.reflectance(*statement.reflectanceMap, definition);
    if (!material.reflectanceMap) material.reflectance = glm::dvec3(grey);
  }
  if (statement.dissolveMap) material.cutOut = images.cutOut(*statement.dissolveMap, definition);
  if (!statement.dissolveMap && material.reflectanceMap && images.hasAlpha(*material.reflectanceMap))
    warnings.push_back(owner + "the alpha of its map_Kd is left out; map_d with the same file makes it a cut-out");
  if (const char* way = wayThrough(statement)) warnings.push_back(owner + opaqueWarning(way));
  const bool isDark = statement.emissionMap && statement.emission == glm::dvec3(0);
  if (isDark) warnings.push_back(owner + "Ke 0 0 0 with a map_Ke; the map alone is the light, as its writers mean it");
  if (statement.emission) material.emission = *statement.emission;
  if (statement.emissionMap) {
    if (!statement.emission || isDark) material.emission = glm::dvec3(1.0);
    material.emissionMap = images.emission(*statement.emissionMap, definition);
    if (!material.emissionMap) material.emission *= grey;
  }
  material.emission *= radiosityPerUnit(settings.emission);
  return material;
}

/// The first names of a list, and how many others there are.
std::string firstOf(const std::vector<std::string>& names) {
  constexpr std::size_t maxNames = 8;
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), maxNames); ++n)
    text += (n == 0 ? "'" : ", '") + raster::excerpt(names[n]) + "'";
  return names.size() > maxNames ? text + " and " + std::to_string(names.size() - maxNames) + " others" : text;
}

}  // namespace

std::optional<std::string> lowerReflectance(glm::dvec3& reflectance, double maxReflectance) {
  bool isLowered = false;
  for (int band = 0; band < 3; ++band) {
    if (reflectance[band] < 1) continue;
    reflectance[band] = maxReflectance;
    isLowered = true;
  }
  if (!isLowered) return std::nullopt;
  return "a reflectance of 1 or more is lowered to " + raster::toText(maxReflectance);
}

std::string opaqueWarning(const std::string& statement) {
  return "it lets light through (" + statement + "), but is read as opaque";
}

int withSampler(MaterialSet& set, int image, const Sampler& sampler, std::vector<int>& variants,
                raster::RunningRequest& memory) {
  const auto at = [&](int number) -> Image& { return set.images[static_cast<std::size_t>(number)]; };
  const auto known =
      std::find_if(variants.begin(), variants.end(), [&](int number) { return at(number).sampler == sampler; });
  if (known != variants.end()) return *known;
  if (!variants.empty()) {
    memory.add(bytesOf(at(image)));
    set.images.push_back(Image(at(image)));
    image = static_cast<int>(set.images.size()) - 1;
  }
  variants.push_back(image);
  at(image).sampler = sampler;
  return image;
}

MaterialSet findMaterials(const std::vector<std::string>& names, const std::vector<std::filesystem::path>& files,
                          const SceneSettings& settings, std::optional<double> unnamed) {
  MaterialSet set;
  const std::map<std::string, Definition> definitions = readDefinitions(files, settings.emission, set);
  MapImages images(set);
  std::vector<std::string> unknown;
  for (const std::string& name : names) {
    const auto found = definitions.find(name);
    if (found != definitions.end()) {
      set.materials.push_back(makeMaterial(found->second, settings, images, set));
    } else if (name.empty()) {
      set.materials.push_back({.name = "default", .reflectance = glm::dvec3(unnamed.value_or(grey))});
      if (!unnamed) set.warnings.push_back("faces without a material become grey 0.5");
    } else {
      set.materials.push_back({.name = name});
      unknown.push_back(name);
    }
  }
  if (!unknown.empty())
    set.warnings.push_back("materials that are in no material file become grey 0.5: " + firstOf(unknown));
  return set;
}

}  // namespace hemitex::radiosity
