#include "radiosity/textures/lit_scene.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "radiosity/images/hole_colours.h"
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

/// A surface of one texel without maps whose corners differ.
bool isGouraud(const Scene& scene, std::uint32_t surface, const std::vector<CornerColours>& corners) {
  return !corners.empty() && !hasMaps(scene, scene.surfaces[surface]) && areDifferent(corners);
}

/// Cuts the holes of a surface into its display texture, whose pixels are those at their middles.
void cutTexture(const Grid& grid, const TexturePlace& place, int magnification, CodedImage& texture) {
  const TexelMask& mask = *grid.mask;
  texture.isHole.resize(texture.codes.size() / 3);
  const auto texelOf = [&](int pixel, int first, int texels, int ofMask) {
    const double chart = ((pixel + 0.5) / magnification - first) / texels;
    return std::clamp(static_cast<int>(std::floor(chart * ofMask)), 0, ofMask - 1);
  };
  for (int y = (place.row - 1) * magnification; y < (place.row + grid.rows + 1) * magnification; ++y)
    for (int x = (place.column - 1) * magnification; x < (place.column + grid.columns + 1) * magnification; ++x) {
      const int column = texelOf(x, place.column, grid.columns, mask.columns),
                row = texelOf(y, place.row, grid.rows, mask.rows);
      texture.isHole[static_cast<std::size_t>((texture.height - 1 - y) * texture.width + x)] =
          mask.isHole[static_cast<std::size_t>(row * mask.columns + column)];
    }
}

/// Cuts the holes of all surfaces. Returns the cut-out of each texture; null without one.
std::vector<std::shared_ptr<const CutOut>> cutTextures(const Discretization& discretization,
                                                       const TextureLayout& layout, std::vector<CodedImage>& textures) {
  for (std::size_t s = 0; s < discretization.grids.size(); ++s) {
    const auto t = static_cast<std::size_t>(layout.places[s].texture);
    if (discretization.grids[s].mask)
      cutTexture(discretization.grids[s], layout.places[s], layout.textures[t].magnification, textures[t]);
  }
  std::vector<std::shared_ptr<const CutOut>> cutOuts(textures.size());
  for (std::size_t t = 0; t < textures.size(); ++t) {
    CodedImage& texture = textures[t];
    if (texture.isHole.empty()) continue;
    cutOuts[t] = std::make_shared<CutOut>(CutOut{texture.width, texture.height, texture.isHole, texture.sampler});
    fillHoles(texture, *cutOuts[t]);
  }
  return cutOuts;
}

/// Gives the surfaces of a lit scene a material per name of a material and texture, in the order of the surfaces. It
/// has this name; where that has several textures, `NAME/TEXTURE`. Materials that edits changed keep their names.
void setMaterials(const Scene& scene, const TextureLayout& layout,
                  const std::vector<std::shared_ptr<const CutOut>>& cutOuts, Scene& lit) {
  using NameAndTexture = std::pair<std::string, int>;
  std::map<NameAndTexture, int> numbers;
  std::map<std::string, int> texturesOfName;
  std::vector<NameAndTexture> used;
  std::vector<bool> isCut;
  for (std::size_t s = 0; s < lit.surfaces.size(); ++s) {
    const std::string& name = scene.materials[static_cast<std::size_t>(scene.surfaces[s].material)].name;
    const NameAndTexture pair(name, layout.places[s].texture);
    const auto [known, isNew] = numbers.try_emplace(pair, static_cast<int>(used.size()));
    lit.surfaces[s].material = known->second;
    if (!isNew) continue;
    used.push_back(pair);
    isCut.push_back(cutOutOf(scene, scene.surfaces[s]) != nullptr);
    ++texturesOfName[name];
  }
  // loadScene lowers a reflectance of 1, and the pictures of both are the same.
  const glm::dvec3 reflectance(SceneSettings{}.maxReflectance);
  std::size_t number = 0;
  for (const auto& [name, texture] : used) {
    const std::string suffix =
        texturesOfName[name] > 1 ? "/" + layout.names[static_cast<std::size_t>(texture)] : std::string();
    lit.materials.push_back({.name = name + suffix, .reflectance = reflectance, .reflectanceMap = texture});
    if (isCut[number++]) lit.materials.back().cutOut = cutOuts[static_cast<std::size_t>(texture)];
  }
}

/// The names of materials in the files.
std::vector<std::string> materialNames(const Scene& lit) {
  std::vector<std::string> names;
  for (const Material& material : lit.materials) names.push_back(material.name);
  return uniqueObjNames(names);
}

/// The names of objects in scene.obj, one per surface.
std::vector<std::string> objectNames(const Scene& lit) {
  std::map<int, std::size_t> numbers;
  std::vector<std::string> names;
  for (const Surface& surface : lit.surfaces)
    if (numbers.try_emplace(*surface.object, names.size()).second)
      names.push_back(lit.objects[static_cast<std::size_t>(*surface.object)].name);
  names = uniqueObjNames(names);
  std::vector<std::string> ofSurfaces;
  for (const Surface& surface : lit.surfaces) ofSurfaces.push_back(names[numbers.at(*surface.object)]);
  return ofSurfaces;
}

std::string objText(const Scene& lit) {
  const std::vector<std::string> objects = objectNames(lit), materials = materialNames(lit);
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
  std::optional<int> object, material;  // of the lines before
  for (std::size_t s = 0; s < lit.surfaces.size(); ++s) {
    const Surface& surface = lit.surfaces[s];
    // Some programs divide a scene by objects, others by groups.
    if (object != surface.object) text += "o " + objects[s] + "\ng " + objects[s] + "\n";
    if (object != surface.object || material != surface.material)
      text += "usemtl " + materials[static_cast<std::size_t>(surface.material)] + "\n";
    object = surface.object;
    material = surface.material;
    for (const Triangle& triangle : surface.triangles) {
      std::string face = "f";
      for (std::size_t k = 0; k < 3; ++k) {
        const std::string texcoord = numberOf(texcoords, lineOf("vt", triangle.texcoord[k]));
        face += " " + numberOf(positions, lineOf("v", triangle.position[k])) + "/" + texcoord;
      }
      text += face + "\n";
    }
  }
  return text;
}

std::string mtlText(const LitScene& lit) {
  std::string text = "# Radiosity textures, to be shown without lights.\n";
  const std::vector<std::string> names = materialNames(lit.scene);
  for (std::size_t m = 0; m < names.size(); ++m) {
    const Material& material = lit.scene.materials[m];
    const std::string image = lit.layout.names[static_cast<std::size_t>(*material.reflectanceMap)] + ".png\n";
    text += "newmtl " + names[m] + "\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 0\nmap_Kd " + image;
    if (material.cutOut) text += "map_d " + image;
  }
  return text;
}

}  // namespace

std::vector<CodedImage> displayTextures(const Scene& scene, const Discretization& discretization,
                                        const TextureLayout& layout, const std::vector<glm::dvec3>& displayed,
                                        double exposure, TextureFilter filter, const std::vector<ImageLevels>* maps) {
  const std::vector<std::vector<BorderEdge>> borders = borderEdges(scene, discretization, displayed, filter);
  const std::vector<std::vector<CornerColours>> corners = cornerRadiosity(scene, discretization, displayed);
  std::vector<std::vector<std::uint32_t>> gouraud(layout.textures.size());
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (isGouraud(scene, s, corners[s])) gouraud[static_cast<std::size_t>(layout.places[s].texture)].push_back(s);
  std::vector<CodedImage> textures(layout.textures.size());
  raster::parallelFor(textures.size(), [&](std::size_t t) {
    Image texture = filteredTexture(scene, discretization, layout, t, displayed, filter, borders, maps);
    for (const std::uint32_t s : gouraud[t])
      drawCorners(scene.surfaces[s], corners[s], layout.places[s], discretization.grids[s],
                  layout.textures[t].magnification, texture);
    for (glm::dvec3& pixel : texture.pixels) pixel *= exposure;
    textures[t] = encodeSrgb(texture);
  });
  return textures;
}

std::vector<CodedImage> codedTextures(const std::vector<Image>& linear, double exposure) {
  std::vector<CodedImage> textures(linear.size());
  raster::parallelFor(textures.size(), [&](std::size_t t) {
    Image texture = linear[t];
    for (glm::dvec3& pixel : texture.pixels) pixel *= exposure;
    textures[t] = encodeSrgb(texture);
  });
  return textures;
}

std::vector<GltfTexture> writeTextures(const std::filesystem::path& folder, const std::vector<std::string>& names,
                                       const std::vector<CodedImage>& codes, const std::vector<Image>& linear) {
  std::vector<GltfTexture> pngs(names.size());
  raster::parallelFor(names.size(), [&](std::size_t t) {
    writeExr(folder / (names[t] + ".exr"), linear[t]);
    const std::filesystem::path png = folder / (names[t] + ".png");
    pngs[t] = {names[t], encodePng(codes[t], png)};
    raster::writeFile(png, {reinterpret_cast<const char*>(pngs[t].png.data()), pngs[t].png.size()});
  });
  return pngs;
}

void addObjects(Scene& lit) {
  for (Surface& surface : lit.surfaces)
    if (!surface.object) {
      surface.object = static_cast<int>(lit.objects.size());
      lit.objects.push_back({surface.name});
    }
}

LitScene makeLitScene(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      const std::vector<glm::dvec3>& displayed, double exposure, TextureFilter filter) {
  const std::vector<ImageLevels> maps = levelsOfMaps(scene);
  return makeLitScene(scene, discretization, layout,
                      displayTextures(scene, discretization, layout, displayed, exposure, filter, &maps));
}

LitScene makeLitScene(const Scene& scene, const Discretization& discretization, const TextureLayout& layout,
                      std::vector<CodedImage> textures) {
  LitScene lit{{}, layout, std::move(textures)};
  lit.scene.surfaces = scene.surfaces;
  lit.scene.objects = scene.objects;
  addObjects(lit.scene);
  setMaterials(scene, layout, cutTextures(discretization, layout, lit.textures), lit.scene);
  for (Surface& surface : lit.scene.surfaces) surface.hasColours = false;  // the textures show them
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    for (Triangle& triangle : lit.scene.surfaces[s].triangles)
      for (std::size_t k = 0; k < 3; ++k)
        triangle.texcoord[k] = textureCoordinate(discretization, layout, s, triangle.chart[k]);
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
                                       const PictureView& view, const std::vector<Image>& linear) {
  std::vector<GltfTexture> pngs = writeTextures(folder, lit.layout.names, lit.textures, linear);
  raster::writeFile(folder / "scene.obj", objText(lit.scene));
  raster::writeFile(folder / "scene.mtl", mtlText(lit));
  const std::optional<std::string> warning =
      writeGlb(folder / "scene.glb", makeGltfModel(lit.scene, view, std::move(pngs)));
  return warning ? std::vector{*warning} : std::vector<std::string>();
}

}  // namespace hemitex::radiosity
