#include "radiosity/scene.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "radiosity/chart.h"
#include "radiosity/materials.h"
#include "radiosity/obj_file.h"
#include "radiosity/planar_parts.h"
#include "radiosity/text_lines.h"
#include "radiosity/triangulate.h"
#include "raster/input_error.h"

namespace hemitex::radiosity {
namespace {

/// The triangles of one section of the file; a chart is set for quads only, by their corners.
struct Section {
  std::uint32_t index = 0;  ///< in ObjFile::sections
  std::vector<Triangle> triangles;
};

Triangle makeTriangle(const ObjFile& obj, std::uint32_t polygonIndex, const std::array<std::uint32_t, 3>& corners) {
  constexpr std::array<glm::dvec2, 4> quad{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)};
  const ObjPolygon& polygon = obj.polygons[polygonIndex];
  Triangle triangle;
  triangle.polygon = polygonIndex;
  std::array<glm::dvec3, 3> colors{};
  bool colored = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const ObjCorner& corner = obj.corners[polygon.firstCorner + corners[k]];
    triangle.position[k] = obj.positions[corner.position];
    if (polygon.textured) triangle.texcoord[k] = obj.texcoords[*corner.texcoord];
    if (polygon.cornerCount == 4) triangle.chart[k] = quad[corners[k]];
    const std::optional<glm::dvec3>& color = obj.colors[corner.position];
    colored = colored && color.has_value();
    colors[k] = color.value_or(glm::dvec3(0.0));
  }
  if (colored) triangle.cornerColor = colors;
  return triangle;
}

/// Counts faces with a fault, for a warning that names the first.
struct FaceCount {
  int count = 0;
  int firstLine = 0;

  void add(int line) {
    if (count++ == 0) firstLine = line;
  }
  void warn(std::vector<std::string>& warnings, const std::string& what) const {
    if (count == 0) return;
    const std::string faces = count == 1 ? "1 face " : std::to_string(count) + " faces ";
    warnings.push_back(faces + what + " (line " + std::to_string(firstLine) + (count == 1 ? ")" : " first)"));
  }
};

/// Triangles with area, section by section; sections without any are left out.
std::vector<Section> cutPolygons(const ObjFile& obj, std::vector<std::string>& warnings) {
  std::vector<Section> sections(obj.sections.size());
  FaceCount degenerate, crossing;
  std::vector<glm::dvec3> positions;
  for (std::uint32_t p = 0; p < obj.polygons.size(); ++p) {
    const ObjPolygon& polygon = obj.polygons[p];
    positions.clear();
    for (std::uint32_t c = 0; c < polygon.cornerCount; ++c) {
      positions.push_back(obj.positions[obj.corners[polygon.firstCorner + c].position]);
    }
    const Triangulation cut = triangulate(positions);
    std::vector<Triangle>& triangles = sections[polygon.section].triangles;
    const std::size_t before = triangles.size();
    for (const std::array<std::uint32_t, 3>& t : cut.triangles) {
      if (hasArea(positions[t[0]], positions[t[1]], positions[t[2]])) triangles.push_back(makeTriangle(obj, p, t));
    }
    const bool isDegenerate = triangles.size() == before;
    if (isDegenerate) degenerate.add(polygon.line);
    if (cut.crossing && !isDegenerate) crossing.add(polygon.line);
  }
  degenerate.warn(warnings, "without area dropped");
  crossing.warn(warnings, "that cross themselves triangulated as well as can be");
  for (std::uint32_t s = 0; s < sections.size(); ++s) sections[s].index = s;
  std::erase_if(sections, [](const Section& section) { return section.triangles.empty(); });
  return sections;
}

/// `wanted`, or with the first of `~2`, `~3`, ... behind it that is not taken yet.
std::string uniqueName(std::set<std::string>& taken, const std::string& wanted) {
  std::string name = wanted;
  for (int n = 2; !taken.insert(name).second; ++n) name = wanted + "~" + std::to_string(n);
  return name;
}

/// A family for each section: its group, and its material where the group has several.
std::vector<std::string> nameFamilies(const ObjFile& obj, const std::vector<Section>& sections) {
  std::map<std::string, int> materialsOf;
  for (const Section& section : sections) ++materialsOf[obj.sections[section.index].group];
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const Section& section : sections) {
    const auto& [group, material] = obj.sections[section.index];
    const std::string suffix = "/" + (material.empty() ? "default" : material);
    names.push_back(uniqueName(taken, materialsOf[group] > 1 ? group + suffix : group));
  }
  return names;
}

/// The materials that sections name, each once, and which one each section has.
struct MaterialChoice {
  std::vector<std::string> names;
  std::vector<int> ofSection;
};

MaterialChoice chooseMaterials(const ObjFile& obj, const std::vector<Section>& sections) {
  MaterialChoice choice;
  std::map<std::string, int> indices;
  for (const Section& section : sections) {
    const std::string& name = obj.sections[section.index].material;
    const auto [known, isNew] = indices.try_emplace(name, static_cast<int>(choice.names.size()));
    if (isNew) choice.names.push_back(name);
    choice.ofSection.push_back(known->second);
  }
  return choice;
}

/// Lays charts over sections.
class ChartMaker {
 public:
  ChartMaker(const ObjFile& obj, const std::filesystem::path& file, Charts charts)
      : obj_(obj), file_(file), charts_(charts) {}

  /// The section's triangles with their charts: one vector a surface.
  std::vector<std::vector<Triangle>> lay(std::vector<Triangle> triangles, const std::string& family) const {
    if (charts_ == Charts::File) {
      if (const std::optional<std::string> fault = layFromFile(triangles)) {
        fail({file_}, "the texture coordinates of surface '" + family + "' form no chart: " + *fault,
             "choose other charts, or mend the coordinates");
      }
      return {std::move(triangles)};
    }
    if (charts_ == Charts::Auto && (!layFromFile(triangles) || isLoneQuad(triangles))) return {std::move(triangles)};
    return layPlanar(triangles);
  }

 private:
  /// Takes the file's coordinates where they form a chart; else changes nothing and says why they do not.
  std::optional<std::string> layFromFile(std::vector<Triangle>& triangles) const {
    std::vector<ChartTriangle> charts;
    for (const Triangle& triangle : triangles) {
      if (!obj_.polygons[triangle.polygon].textured) return "the face in " + lineOf(triangle) + " has none";
      charts.push_back(roundedChart(triangle.texcoord));
    }
    const std::vector<ChartConflict> conflicts = chartConflicts(charts, 1);
    if (!conflicts.empty()) return describe(conflicts[0], triangles);
    for (std::size_t i = 0; i < triangles.size(); ++i) triangles[i].chart = charts[i];
    return {};
  }

  std::string describe(const ChartConflict& conflict, const std::vector<Triangle>& triangles) const {
    const std::string face = "the face in " + lineOf(triangles[conflict.triangle]);
    switch (conflict.kind) {
      case ChartConflict::Kind::Outside:
        return face + " leaves the unit square";
      case ChartConflict::Kind::NoArea:
        return face + " has no area in them";
      case ChartConflict::Kind::Overlap:
        break;
    }
    return face + " overlaps the one in " + lineOf(triangles[conflict.other]);
  }

  std::string lineOf(const Triangle& triangle) const {
    return "line " + std::to_string(obj_.polygons[triangle.polygon].line);
  }

  bool isLoneQuad(const std::vector<Triangle>& triangles) const {
    return triangles.front().polygon == triangles.back().polygon &&
           obj_.polygons[triangles.front().polygon].cornerCount == 4;
  }

  static std::vector<std::vector<Triangle>> layPlanar(const std::vector<Triangle>& triangles) {
    std::vector<TrianglePositions> positions;
    for (const Triangle& triangle : triangles) positions.push_back(triangle.position);
    std::vector<std::vector<Triangle>> surfaces;
    for (const PlanarPart& part : planarParts(positions)) {
      std::vector<Triangle>& surface = surfaces.emplace_back();
      for (std::size_t i = 0; i < part.triangles.size(); ++i) {
        surface.push_back(triangles[part.triangles[i]]);
        surface.back().chart = part.charts[i];
      }
    }
    return surfaces;
  }

  const ObjFile& obj_;
  const std::filesystem::path& file_;
  Charts charts_;
};

/// The surfaces of one section.
std::vector<Surface> makeSurfaces(std::vector<std::vector<Triangle>> parts, const std::string& family, int material) {
  std::vector<Surface> surfaces;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const std::string name = parts.size() == 1 ? family : family + "#" + std::to_string(n + 1);
    surfaces.push_back({.name = name, .family = family, .material = material, .triangles = std::move(parts[n])});
  }
  return surfaces;
}

/// Maps see the chart where the file has no coordinates.
void completeTexcoords(const ObjFile& obj, std::vector<Surface>& surfaces) {
  for (Surface& surface : surfaces) {
    for (Triangle& triangle : surface.triangles) {
      if (!obj.polygons[triangle.polygon].textured) triangle.texcoord = triangle.chart;
    }
  }
}

template <typename T>
void turnOver(std::array<T, 3>& corners) {
  std::swap(corners[1], corners[2]);
}

/// The other side: the same triangles the other way round, each corner with its own coordinates.
Surface backOf(const Surface& front) {
  Surface back = front;
  back.name += "/back";
  back.family += "/back";
  for (Triangle& triangle : back.triangles) {
    turnOver(triangle.position);
    turnOver(triangle.chart);
    turnOver(triangle.texcoord);
    if (triangle.cornerColor) turnOver(*triangle.cornerColor);
  }
  return back;
}

void addBacks(std::vector<Surface>& surfaces) {
  const std::size_t fronts = surfaces.size();
  for (std::size_t s = 0; s < fronts; ++s) {
    surfaces.push_back(backOf(surfaces[s]));
    surfaces[s].twin = static_cast<int>(fronts + s);
    surfaces.back().twin = static_cast<int>(s);
  }
}

void measureBounds(Scene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Surface& surface : scene.surfaces) {
    for (const Triangle& triangle : surface.triangles) {
      for (const glm::dvec3& p : triangle.position) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
  }
  scene.origin = 0.5 * (low + high);
  scene.extent = glm::length(high - low);
}

/// Whether a material emits in some band somewhere.
bool emits(const Scene& scene, const Material& material) {
  glm::dvec3 largest(1.0);
  if (material.emissionMap) {
    largest = glm::dvec3(0.0);
    const Image& map = scene.images[static_cast<std::size_t>(*material.emissionMap)];
    for (const glm::dvec3& pixel : map.pixels) largest = glm::max(largest, pixel);
  }
  const glm::dvec3 emission = material.emission * largest;
  return emission.r > 0 || emission.g > 0 || emission.b > 0;
}

glm::dvec3 doubledArea(const Triangle& t) {
  return glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]);
}

}  // namespace

Scene loadScene(const std::filesystem::path& file, const SceneSettings& settings) {
  if (!(settings.maxReflectance >= 0 && settings.maxReflectance < 1)) {
    throw raster::InputError("the largest reflectance must be at least 0 and below 1");
  }
  const ObjFile obj = readObj(file);
  Scene scene;
  std::vector<Section> sections = cutPolygons(obj, scene.warnings);
  if (sections.empty()) fail({file}, "the scene is empty: it has no face with area");

  const MaterialChoice choice = chooseMaterials(obj, sections);
  std::vector<std::filesystem::path> materialFiles;
  for (const std::filesystem::path& name : obj.materialFiles) materialFiles.push_back(file.parent_path() / name);
  MaterialSet found = findMaterials(choice.names, materialFiles, settings.maxReflectance);
  scene.materials = std::move(found.materials);
  scene.images = std::move(found.images);
  std::move(found.warnings.begin(), found.warnings.end(), std::back_inserter(scene.warnings));

  const std::vector<std::string> families = nameFamilies(obj, sections);
  const ChartMaker charts(obj, file, settings.charts);
  for (std::size_t s = 0; s < sections.size(); ++s) {
    std::vector<Surface> surfaces =
        makeSurfaces(charts.lay(std::move(sections[s].triangles), families[s]), families[s], choice.ofSection[s]);
    std::move(surfaces.begin(), surfaces.end(), std::back_inserter(scene.surfaces));
  }
  completeTexcoords(obj, scene.surfaces);
  if (settings.twoSided) addBacks(scene.surfaces);
  std::set<std::string> taken;
  for (Surface& surface : scene.surfaces) surface.name = uniqueName(taken, surface.name);
  measureBounds(scene);
  return scene;
}

void requireEmission(const Scene& scene, const std::filesystem::path& file) {
  if (std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) { return emits(scene, m); })) {
    return;
  }
  fail({file}, "nothing in the scene emits light", "give a material an emission (Ke in the MTL file)");
}

double area(const Triangle& triangle) { return 0.5 * glm::length(doubledArea(triangle)); }

glm::dvec3 normal(const Triangle& triangle) {
  const glm::dvec3 direction = doubledArea(triangle);
  return direction / glm::length(direction);
}

std::size_t triangleCount(const Scene& scene) {
  std::size_t count = 0;
  for (const Surface& surface : scene.surfaces) count += surface.triangles.size();
  return count;
}

}  // namespace hemitex::radiosity
