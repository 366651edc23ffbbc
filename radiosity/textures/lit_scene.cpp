#include "radiosity/textures/lit_scene.h"

#include <charconv>
#include <string>
#include <unordered_map>

#include "radiosity/scene/image.h"
#include "radiosity/textures/corner_radiosity.h"
#include "radiosity/textures/file_names.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"

namespace hemitex::radiosity {
namespace {

/// Appends a blank and the shortest decimal number that parses to the same bits.
void appendNumber(std::string& text, double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text += ' ';
  text.append(digits, end);
}

template <typename Vector>
std::string lineOf(const char* keyword, const Vector& vector) {
  std::string line = keyword;
  for (int i = 0; i < vector.length(); ++i) appendNumber(line, vector[i]);
  return line;
}

/// Lines that faces refer to by number; equal lines are written once.
class Lines {
 public:
  /// The number of a line, counted from 1. Appends new lines to `text`.
  std::size_t number(std::string& text, const std::string& line) {
    const auto [place, isNew] = numbers_.try_emplace(line, numbers_.size() + 1);
    if (isNew) text += line + "\n";
    return place->second;
  }

 private:
  std::unordered_map<std::string, std::size_t> numbers_;
};

using Corners = std::array<glm::dvec3, 3>;

/// Exposed radiosity at the corners of the scene's triangles, and whether a surface needs them because its texture has
/// only one colour.
class GouraudCorners {
 public:
  GouraudCorners(const Scene& scene, const Discretization& discretization, const std::vector<glm::dvec3>& exposed)
      : corners_(cornerRadiosity(scene, discretization, exposed)) {
    std::size_t first = 0;
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
      first_.push_back(first);
      first += scene.surfaces[s].triangles.size();
      isNeeded_.push_back(!isDiscretized(discretization.grids[s]) && !isConstant(first_[s], first));
    }
  }

  bool isNeeded(std::size_t surface) const { return isNeeded_[surface]; }
  const Corners& at(std::size_t surface, std::size_t triangle) const { return corners_[first_[surface] + triangle]; }

 private:
  bool isConstant(std::size_t first, std::size_t last) const {
    for (std::size_t t = first; t < last; ++t)
      for (const glm::dvec3& corner : corners_[t])
        if (corner != corners_[first][0]) return false;
    return true;
  }

  std::vector<Corners> corners_;
  std::vector<std::size_t> first_;
  std::vector<bool> isNeeded_;
};

/// The colour of a vertex line, sRGB-encoded and rounded to 8-bit codes.
glm::dvec3 encodedColour(const glm::dvec3& linear) {
  return glm::dvec3(encodeSrgb(linear.x), encodeSrgb(linear.y), encodeSrgb(linear.z)) / 255.0;
}

/// The name of the material without a map; no texture has this name.
std::string gouraudMaterial(const TextureLayout& layout) {
  std::vector<std::string> names = layout.names;
  names.push_back("gouraud");
  return uniqueFileNames(names).back();
}

std::string objText(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                    const GouraudCorners& gouraud) {
  std::vector<std::string> surfaceNames;
  for (const Surface& surface : scene.surfaces) surfaceNames.push_back(surface.name);
  const std::vector<std::string> groups = uniqueFileNames(surfaceNames);

  const std::string mapless = gouraudMaterial(layout);
  std::string text =
      "# A scene lit by radiosity: show it without lights, its textures hold the light.\nmtllib scene.mtl\n";
  Lines positions, texcoords;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const std::string& texture = layout.names[static_cast<std::size_t>(layout.places[s].texture)];
    text += "g " + groups[s] + "\nusemtl " + (gouraud.isNeeded(s) ? mapless : texture) + "\n";
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      const Triangle& triangle = surface.triangles[t];
      std::string face = "f";
      for (std::size_t k = 0; k < 3; ++k) {
        std::string position = lineOf("v", triangle.position[k]);
        if (gouraud.isNeeded(s)) position += lineOf("", encodedColour(gouraud.at(s, t)[k]));
        const glm::dvec2 uv = textureCoordinate(discretization, layout, s, triangle.chart[k]);
        face += " " + std::to_string(positions.number(text, position)) + "/" +
                std::to_string(texcoords.number(text, lineOf("vt", uv)));
      }
      text += face + "\n";
    }
  }
  return text;
}

std::string materialText(const std::string& name, const std::string& map) {
  return "newmtl " + name + "\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 0\n" + (map.empty() ? "" : "map_Kd " + map + "\n");
}

std::string mtlText(const TextureLayout& layout) {
  std::string text = "# Radiosity textures, to be shown without lights.\n";
  for (const std::string& name : layout.names) text += materialText(name, name + ".png");
  return text + materialText(gouraudMaterial(layout), "");
}

/// The displayed radiosity of each element times the exposure: 1 is the brightest value of a display.
std::vector<glm::dvec3> exposedRadiosity(const Scene& scene, const Discretization& discretization,
                                         const Solution& solution, double exposure) {
  std::vector<glm::dvec3> exposed = displayRadiosity(scene, discretization, solution);
  for (glm::dvec3& value : exposed) value *= exposure;
  return exposed;
}

using Writer = void (*)(const std::filesystem::path&, const Image&);

void writeTextures(const std::filesystem::path& folder, const TextureLayout& layout, const std::string& ending,
                   const std::vector<Image>& textures, Writer write) {
  for (std::size_t t = 0; t < textures.size(); ++t) write(folder / (layout.names[t] + ending), textures[t]);
}

}  // namespace

void writeLitScene(const std::filesystem::path& folder, const Scene& scene, const Discretization& discretization,
                   const Solution& solution, double exposure, const TextureSettings& textures) {
  const TextureLayout layout = layOutTextures(scene, discretization);
  const std::vector<glm::dvec3> exposed = exposedRadiosity(scene, discretization, solution, exposure);
  writeTextures(folder, layout, ".exr", radiosityTextures(discretization, layout, solution.radiosity), writeExr);
  writeTextures(folder, layout, ".png", filteredTextures(scene, discretization, layout, exposed, textures), writePng);
  const GouraudCorners gouraud(scene, discretization, exposed);
  raster::writeFile(folder / "scene.obj", objText(scene, discretization, layout, gouraud));
  raster::writeFile(folder / "scene.mtl", mtlText(layout));
}

}  // namespace hemitex::radiosity
