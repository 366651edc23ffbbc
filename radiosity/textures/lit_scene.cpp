#include "radiosity/textures/lit_scene.h"

#include <charconv>
#include <optional>
#include <unordered_map>

#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/scene_settings.h"
#include "radiosity/textures/corner_radiosity.h"
#include "radiosity/textures/file_names.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// The keyword and numbers, each after a blank, with the fewest digits that parse to the same bits.
template <typename Vector>
std::string lineOf(const char* keyword, const Vector& vector) {
  std::string line = keyword;
  for (int i = 0; i < vector.length(); ++i) {
    char digits[32];
    line += ' ';
    line.append(digits, std::to_chars(digits, digits + sizeof digits, vector[i]).ptr);
  }
  return line;
}

/// Whether the corners of a surface of one texel differ, so that its texture is not enough.
bool areDifferent(const std::vector<CornerColours>& triangles) {
  for (const CornerColours& triangle : triangles)
    for (const glm::dvec3& corner : triangle)
      if (corner != triangles.front().front()) return true;
  return false;
}

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
std::vector<CodedImage> codedTextures(const Scene& scene, const Discretization& discretization,
                                      const TextureLayout& layout, const std::vector<glm::dvec3>& displayed,
                                      double exposure, TextureFilter filter) {
  const std::vector<std::vector<BorderEdge>> borders = borderEdges(scene, discretization, displayed, filter);
  const std::vector<ImageLevels> maps = levelsOfMaps(scene);
  std::vector<CodedImage> textures(layout.textures.size());
  raster::parallelFor(textures.size(), [&](std::size_t t) {
    Image texture = filteredTexture(scene, discretization, layout, t, displayed, filter, borders, maps);
    for (glm::dvec3& pixel : texture.pixels) pixel *= exposure;
    textures[t] = encodeSrgb(texture);
  });
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
  const std::vector<std::string> names = objectNames(lit);
  std::string text =
      "# A scene lit by radiosity: show it without lights, its textures hold the light.\nmtllib scene.mtl\n";
  // The numbers of lines that faces refer to, counted from 1; equal lines are written once.
  using Numbers = std::unordered_map<std::string, std::size_t>;
  Numbers positions, texcoords;
  const auto numberOf = [&text](Numbers& numbers, const std::string& line) {
    const auto [place, isNew] = numbers.try_emplace(line, numbers.size() + 1);
    if (isNew) text += line + "\n";
    return std::to_string(place->second);
  };
  for (std::size_t s = 0; s < lit.surfaces.size(); ++s) {
    const Surface& surface = lit.surfaces[s];
    // Some programs divide a scene by objects, others by groups.
    text += "o " + names[s] + "\ng " + names[s] + "\nusemtl " +
            lit.materials[static_cast<std::size_t>(surface.material)].name + "\n";
    for (const Triangle& triangle : surface.triangles) {
      std::string face = "f";
      for (std::size_t k = 0; k < 3; ++k) {
        std::string position = lineOf("v", triangle.position[k]);
        if (triangle.cornerColor) position += lineOf("", (*triangle.cornerColor)[k]);
        const std::string texcoord = numberOf(texcoords, lineOf("vt", triangle.texcoord[k]));
        face += " " + numberOf(positions, position) + "/" + texcoord;
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

LitScene makeLitScene(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      const std::vector<glm::dvec3>& displayed, double exposure, TextureFilter filter) {
  LitScene lit{{}, layout, codedTextures(scene, discretization, layout, displayed, exposure, filter)};
  lit.scene.surfaces = scene.surfaces;
  lit.scene.materials = litMaterials(layout);
  const std::vector<std::vector<CornerColours>> corners = cornerRadiosity(scene, discretization, displayed);
  const auto mapless = static_cast<int>(layout.names.size());
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    Surface& surface = lit.scene.surfaces[s];
    const bool isGouraud = !hasMaps(scene, scene.surfaces[s]) && areDifferent(corners[s]);
    surface.material = isGouraud ? mapless : layout.places[s].texture;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      Triangle& triangle = surface.triangles[t];
      triangle.cornerColor.reset();
      if (isGouraud) triangle.cornerColor.emplace();
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.texcoord[k] = textureCoordinate(discretization, layout, s, triangle.chart[k]);
        if (triangle.cornerColor) (*triangle.cornerColor)[k] = encodedColour(exposure * corners[s][t][k]);
      }
    }
  }
  measureBounds(lit.scene);
  return lit;
}

Image unlitPicture(const LitScene& lit, const Camera& camera, int width, int height, const glm::dvec3& background) {
  const auto mapColour = [&](std::size_t map, const glm::dvec2& uv) { return bilinear(lit.textures[map], uv); };
  return drawPicture(
      lit.scene, camera, width, height,
      [&](const Visible& visible) { return unlitColour(lit.scene, visible, mapColour); }, background);
}

std::vector<std::string> writeLitScene(const std::filesystem::path& folder, const LitScene& lit,
                                       const PictureView& view, const Discretization& discretization,
                                       const std::vector<glm::dvec3>& radiosity) {
  const std::vector<Image> linear = radiosityTextures(discretization, lit.layout, radiosity);
  std::vector<std::vector<unsigned char>> pngs(linear.size());
  raster::parallelFor(linear.size(), [&](std::size_t t) {
    writeExr(folder / (lit.layout.names[t] + ".exr"), linear[t]);
    const std::filesystem::path png = folder / (lit.layout.names[t] + ".png");
    pngs[t] = encodePng(lit.textures[t], png);
    raster::writeFile(png, {reinterpret_cast<const char*>(pngs[t].data()), pngs[t].size()});
  });
  raster::writeFile(folder / "scene.obj", objText(lit.scene));
  raster::writeFile(folder / "scene.mtl", mtlText(lit.scene));
  const std::optional<std::string> warning =
      writeGlb(folder / "scene.glb", makeGltfModel(lit.scene, view, std::move(pngs)));
  return warning ? std::vector{*warning} : std::vector<std::string>();
}

}  // namespace hemitex::radiosity
