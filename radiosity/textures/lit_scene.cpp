#include "radiosity/textures/lit_scene.h"

#include <charconv>
#include <string>
#include <unordered_map>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene_settings.h"
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

/// The display textures with the 256 values per channel that an 8-bit sRGB file holds.
std::vector<Image> quantized(std::vector<Image> textures) {
  for (Image& texture : textures)
    for (glm::dvec3& pixel : texture.pixels)
      for (int band = 0; band < 3; ++band) pixel[band] = decodeSrgb(encodeSrgb(pixel[band]) / 255.0);
  return textures;
}

/// A material per texture, and behind them the one without a map.
std::vector<Material> litMaterials(const TextureLayout& layout) {
  // loadScene lowers a reflectance of 1, and the pictures of both are the same.
  const glm::dvec3 reflectance(SceneSettings{}.maxReflectance);
  std::vector<Material> materials;
  for (const std::string& name : layout.names)
    materials.push_back(
        {.name = name, .reflectance = reflectance, .reflectanceMap = static_cast<int>(materials.size())});
  materials.push_back({.name = gouraudMaterial(layout), .reflectance = reflectance});
  return materials;
}

std::string objText(const Scene& lit) {
  std::vector<std::string> surfaceNames;
  for (const Surface& surface : lit.surfaces) surfaceNames.push_back(surface.name);
  const std::vector<std::string> groups = uniqueFileNames(surfaceNames);

  std::string text =
      "# A scene lit by radiosity: show it without lights, its textures hold the light.\nmtllib scene.mtl\n";
  Lines positions, texcoords;
  for (std::size_t s = 0; s < lit.surfaces.size(); ++s) {
    const Surface& surface = lit.surfaces[s];
    text += "g " + groups[s] + "\nusemtl " + lit.materials[static_cast<std::size_t>(surface.material)].name + "\n";
    for (const Triangle& triangle : surface.triangles) {
      std::string face = "f";
      for (std::size_t k = 0; k < 3; ++k) {
        std::string position = lineOf("v", triangle.position[k]);
        if (triangle.cornerColor) position += lineOf("", (*triangle.cornerColor)[k]);
        face += " " + std::to_string(positions.number(text, position)) + "/" +
                std::to_string(texcoords.number(text, lineOf("vt", triangle.texcoord[k])));
      }
      text += face + "\n";
    }
  }
  return text;
}

std::string mtlText(const Scene& lit) {
  std::string text = "# Radiosity textures, to be shown without lights.\n";
  for (const Material& material : lit.materials) {
    text += "newmtl " + material.name + "\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 0\n";
    if (material.reflectanceMap) text += "map_Kd " + material.name + ".png\n";
  }
  return text;
}

}  // namespace

LitScene makeLitScene(const Scene& scene, const Discretization& discretization,
                      const std::vector<glm::dvec3>& displayed, double exposure, const TextureSettings& textures) {
  std::vector<glm::dvec3> exposed = displayed;
  for (glm::dvec3& value : exposed) value *= exposure;
  LitScene lit{{}, layOutTextures(scene, discretization)};
  lit.scene.surfaces = scene.surfaces;
  lit.scene.materials = litMaterials(lit.layout);
  lit.scene.images = quantized(filteredTextures(scene, discretization, lit.layout, exposed, textures));
  const GouraudCorners gouraud(scene, discretization, exposed);
  const auto mapless = static_cast<int>(lit.layout.names.size());
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    Surface& surface = lit.scene.surfaces[s];
    surface.material = gouraud.isNeeded(s) ? mapless : lit.layout.places[s].texture;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      Triangle& triangle = surface.triangles[t];
      triangle.cornerColor.reset();
      if (gouraud.isNeeded(s)) triangle.cornerColor.emplace();
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.texcoord[k] = textureCoordinate(discretization, lit.layout, s, triangle.chart[k]);
        if (triangle.cornerColor) (*triangle.cornerColor)[k] = encodedColour(gouraud.at(s, t)[k]);
      }
    }
  }
  measureBounds(lit.scene);
  return lit;
}

void writeLitScene(const std::filesystem::path& folder, const LitScene& lit, const Discretization& discretization,
                   const std::vector<glm::dvec3>& radiosity) {
  const std::vector<Image> linear = radiosityTextures(discretization, lit.layout, radiosity);
  for (std::size_t t = 0; t < linear.size(); ++t) {
    writeExr(folder / (lit.layout.names[t] + ".exr"), linear[t]);
    writePng(folder / (lit.layout.names[t] + ".png"), lit.scene.images[t]);
  }
  raster::writeFile(folder / "scene.obj", objText(lit.scene));
  raster::writeFile(folder / "scene.mtl", mtlText(lit.scene));
}

}  // namespace hemitex::radiosity
