#include "radiosity/scene/load_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "radiosity/base/named_file.h"
#include "radiosity/base/text_lines.h"
#include "radiosity/base/unique_names.h"
#include "radiosity/images/hole_colours.h"
#include "radiosity/meshes/mesh_formats.h"
#include "radiosity/meshes/obj_file.h"
#include "radiosity/scene/contacts.h"
#include "radiosity/scene/face_materials.h"
#include "radiosity/scene/gltf_file.h"
#include "radiosity/scene/materials.h"
#include "radiosity/scene/mesh_sections.h"
#include "radiosity/scene/open_sheets.h"
#include "radiosity/scene/section_charts.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/lower_case.h"
#include "raster/base/memory_budget.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

/// The square of a smaller length would leave the range of binary32, which drawing uses.
constexpr double smallestExtent = 1e-18;

/// Lower bound for the brightest light. The light of weaker ones would leave the range of binary32, which images use.
constexpr double smallestEmission = 1e-30;

bool isGltf(const std::filesystem::path& file) {
  return raster::endingOf(file) == ".gltf" || raster::endingOf(file) == ".glb";
}

using CellNames = std::span<const std::string>;

void refuseCellData(const std::filesystem::path& file, CellNames names) {
  if (!names.empty()) fail({file}, "has no cell data", "give a VTK file (.vtu, .vtp or .vtk)");
}

/// A parser of files that have no cell data.
template <PolygonMesh (*parse)(std::string_view, const std::filesystem::path&)>
PolygonMesh withoutCellData(std::string_view bytes, const std::filesystem::path& file, CellNames cellData) {
  refuseCellData(file, cellData);
  return parse(bytes, file);
}

/// A format of plain meshes: the end of a file's name, the bytes with which such files start, if they always do, and
/// the function that parses them, with the given cell data.
struct MeshFormat {
  std::string_view ending, start, name;
  PolygonMesh (*parse)(std::string_view bytes, const std::filesystem::path& file, CellNames cellData);
};

constexpr std::array meshFormats{MeshFormat{".stl", "solid ", "an STL mesh", withoutCellData<parseStl>},
                                 MeshFormat{".ply", "ply", "a PLY mesh", withoutCellData<parsePly>},
                                 MeshFormat{".vtk", "# vtk DataFile", "a VTK file", parseLegacyVtk},
                                 MeshFormat{".vtu", "<VTKFile", "a VTK file", parseVtkXml},
                                 MeshFormat{".vtp", "<VTKFile", "a VTK file", parseVtkXml},
                                 MeshFormat{".vs3", "", "a View3D file", withoutCellData<parseVs3>}};

/// A format that is not read.
struct ForeignFormat {
  std::string_view ending, start, name;
};

constexpr std::array foreignFormats{ForeignFormat{".fbx", "Kaydara FBX", "an FBX scene"},
                                    ForeignFormat{".blend", "BLENDER", "a Blender file"},
                                    ForeignFormat{".3ds", "", "a 3DS scene"},
                                    ForeignFormat{".3mf", "", "a 3MF mesh"},
                                    ForeignFormat{".dae", "", "a COLLADA scene"},
                                    ForeignFormat{".usdz", "", "a USD scene"},
                                    ForeignFormat{".usdc", "PXR-USDC", "a USD scene"},
                                    ForeignFormat{".skp", "", "a SketchUp file"},
                                    ForeignFormat{".msh", "$MeshFormat", "a Gmsh mesh"},
                                    ForeignFormat{".step", "ISO-10303-21", "a STEP file"},
                                    ForeignFormat{".stp", "ISO-10303-21", "a STEP file"},
                                    ForeignFormat{".off", "OFF", "an OFF mesh"}};

/// The format of plain meshes that a name has; null for OBJ, glTF and unknown ones.
const MeshFormat* meshFormatOf(const std::filesystem::path& file) {
  const auto found = std::find_if(meshFormats.begin(), meshFormats.end(),
                                  [&](const MeshFormat& format) { return raster::endingOf(file) == format.ending; });
  return found == meshFormats.end() ? nullptr : &*found;
}

/// Throws InputError for a file that is not what its name says, by its name or its first bytes.
void refuseForeignFormat(const std::filesystem::path& file) {
  const raster::InputFile opened = raster::tryOpenFile(file);
  if (!opened) return;  // reading it says why
  std::array<char, 16> bytes{};
  const std::string_view start(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), opened.get()));
  for (const ForeignFormat& format : foreignFormats)
    if (raster::endingOf(file) == format.ending || (!format.start.empty() && start.starts_with(format.start)))
      fail({file}, "is " + std::string(format.name) + ", which is not read", "export it as OBJ, glTF, STL, PLY or VTU");
  if (meshFormatOf(file) != nullptr) return;  // its parser says what is wrong
  for (const MeshFormat& format : meshFormats)
    if (!format.start.empty() && start.starts_with(format.start))
      fail({file}, "is " + std::string(format.name) + ", not OBJ or glTF",
           "give it a name that ends in " + std::string(format.ending));
}

/// The faces of a file that is no glTF.
PolygonMesh readMesh(const std::filesystem::path& file, CellNames cellData) {
  if (const MeshFormat* plain = meshFormatOf(file)) {
    const std::string bytes = raster::readFile(file, "check the path, and that it is a file you may read");
    constexpr std::uint64_t copies = 2;  // as a tree of elements, and as a mesh
    raster::requireMemory(copies * bytes.size(), file.string(), "the mesh in the file", "divide it");
    return plain->parse(bytes, file, cellData);
  }
  refuseCellData(file, cellData);
  return readObj(file);
}

/// The names of the cell data that are read.
std::vector<std::string> cellDataOf(const SceneSettings& settings) {
  std::set<std::string> names{settings.cellReflectance, settings.cellEmission};
  names.erase("");
  return {names.begin(), names.end()};
}

/// The argument of `mtllib` is one file name with blanks if such a file exists, else one file name per word.
std::vector<std::filesystem::path> materialFiles(const PolygonMesh& mesh, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::string& library : mesh.materialLibraries) {
    if (const auto whole = namedFile(folder, library)) {
      files.push_back(*whole);
      continue;
    }
    std::string_view rest = library;
    for (auto word = nextWord(rest); word; word = nextWord(rest))
      files.push_back(namedFile(folder, std::string(*word)).value_or(folder / *word));
  }
  return files;
}

/// The distinct names of materials, and the material of each section.
struct MaterialChoice {
  std::vector<std::string> names;
  std::vector<int> ofSection;
};

MaterialChoice chooseMaterials(const std::vector<Section>& sections) {
  MaterialChoice choice;
  std::map<std::string, int> indices;
  for (const Section& section : sections) {
    const auto [known, isNew] = indices.try_emplace(section.material, static_cast<int>(choice.names.size()));
    if (isNew) choice.names.push_back(section.material);
    choice.ofSection.push_back(known->second);
  }
  return choice;
}

MaterialSet materialsNamed(const std::vector<std::string>& names, const std::map<std::string, Material>& known) {
  MaterialSet set;
  for (const std::string& name : names) set.materials.push_back(known.at(name));
  return set;
}

bool isColoured(const Triangle& triangle) {
  return std::any_of(triangle.colour.begin(), triangle.colour.end(),
                     [](const glm::vec3& colour) { return colour != glm::vec3(1); });
}

void addSurfaces(Scene& scene, std::vector<Surface> parts, const std::string& family, int material, int object) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    parts[n].name = parts.size() == 1 ? family : family + "#" + std::to_string(n + 1);
    parts[n].family = family;
    parts[n].material = material;
    parts[n].object = object;
    parts[n].hasColours = std::any_of(parts[n].triangles.begin(), parts[n].triangles.end(), isColoured);
    scene.surfaces.push_back(std::move(parts[n]));
  }
}

std::vector<std::uint32_t> allSurfaces(const Scene& scene) {
  std::vector<std::uint32_t> numbers(scene.surfaces.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  return numbers;
}

/// The other side of a surface.
Surface backOf(const Surface& front) {
  Surface back = front;
  back.name += "/back";
  back.family += "/back";
  turnOver(back);
  return back;
}

/// Gives some surfaces, by their numbers, a surface on the other side. Those of an object are an object of their own,
/// because programs take faces with equal corners in one mesh for a fault.
void addBacks(Scene& scene, const std::vector<std::uint32_t>& numbers) {
  std::vector<Surface>& surfaces = scene.surfaces;
  std::map<int, int> backObjects;
  for (const std::uint32_t s : numbers) {
    surfaces.push_back(backOf(surfaces[s]));
    const int front = *surfaces[s].object;
    const auto [known, isNew] = backObjects.try_emplace(front, static_cast<int>(scene.objects.size()));
    if (isNew) {
      const SceneObject object = scene.objects[static_cast<std::size_t>(front)];
      scene.objects.push_back({object.name + "/back", object.parent});
    }
    surfaces.back().object = known->second;
    makeTwins(surfaces, s, surfaces.size() - 1);
  }
}

/// The cut-outs that the file says are double-sided.
std::vector<std::uint32_t> doubleSidedCutOuts(const Scene& scene) {
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t s : allSurfaces(scene))
    if (scene.materials[static_cast<std::size_t>(scene.surfaces[s].material)].isDoubleSided) numbers.push_back(s);
  return numbers;
}

/// Gives all surfaces of facets a back. That of facet n of N is the facet n + N.
void addBacksOfFacets(Scene& scene) {
  const std::size_t fronts = scene.surfaces.size();
  addBacks(scene, allSurfaces(scene));
  for (std::size_t s = fronts; s < scene.surfaces.size(); ++s)
    for (Triangle& triangle : scene.surfaces[s].triangles) triangle.polygon += static_cast<std::uint32_t>(scene.faces);
  scene.faces *= 2;
}

/// The open sheets that are lit from both sides, after contacts.
std::vector<std::uint32_t> sheetsOf(const Scene& scene, const Contacts& contacts) {
  const bool hasContacts =
      std::any_of(contacts.parts.begin(), contacts.parts.end(), [](const auto& parts) { return !parts.empty(); });
  return sheetsLitFromBothSides(hasContacts ? resolved(scene, contacts) : scene);
}

/// Turns surfaces over by their names. Throws InputError with similar names if there is none.
void flip(Scene& scene, const std::vector<std::string>& names, const std::filesystem::path& file) try {
  for (const std::string& name : names)
    for (const std::uint32_t s : surfacesNamed(scene, name)) turnOver(scene.surfaces[s]);
} catch (const raster::InputError& error) {
  throw raster::InputError(file.string(), 0, error.what());
}

void makeNamesUnique(std::vector<Surface>& surfaces) {
  UniqueNames names;
  for (Surface& surface : surfaces) surface.name = names.add(surface.name);
}

/// Fills the holes in the maps of materials (see fillHoles). An image whose materials have several cut-outs, or some
/// with one and some without, is copied.
void fillHolesOfMaps(Scene& scene) {
  const std::array<std::optional<int> Material::*, 2> maps{&Material::reflectanceMap, &Material::emissionMap};
  struct Variant {
    const CutOut* cutOut;  // null for none
    int image;
  };
  const auto areEqual = [](const CutOut* a, const CutOut* b) {
    return a == b || (a && b && a->width == b->width && a->sampler == b->sampler && a->isHole == b->isHole);
  };
  std::map<int, std::vector<Variant>> variants;
  const auto variantOf = [&](int map, const CutOut* cutOut) {
    return std::find_if(variants[map].begin(), variants[map].end(),
                        [&](const Variant& known) { return areEqual(known.cutOut, cutOut); });
  };
  for (const Material& material : scene.materials)
    for (const auto map : maps)
      if (const std::optional<int> image = material.*map;
          image && variantOf(*image, material.cutOut.get()) == variants[*image].end())
        variants[*image].push_back({material.cutOut.get(), *image});
  for (auto& [image, ofImage] : variants)
    for (std::size_t v = ofImage.size(); v-- > 0;) {
      if (v > 0) {
        ofImage[v].image = static_cast<int>(scene.images.size());
        scene.images.push_back(scene.images[static_cast<std::size_t>(image)]);
      }
      if (ofImage[v].cutOut) fillHoles(scene.images[static_cast<std::size_t>(ofImage[v].image)], *ofImage[v].cutOut);
    }
  for (Material& material : scene.materials)
    for (const auto map : maps)
      if (material.*map) material.*map = variantOf(*(material.*map), material.cutOut.get())->image;
}

glm::dvec3 meanOf(const Image& image) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& pixel : image.pixels) sum += pixel;
  return sum / static_cast<double>(image.pixels.size());
}

/// The largest emission of a material in any band.
double brightestEmission(const Scene& scene, const Material& material) {
  glm::dvec3 largest(1.0);
  if (material.emissionMap) {
    largest = glm::dvec3(0.0);
    const Image& map = scene.images[static_cast<std::size_t>(*material.emissionMap)];
    for (const glm::dvec3& pixel : map.pixels) largest = glm::max(largest, pixel);
  }
  const Bands emission = emissionInBands(scene, material);
  double brightest = 0;
  for (std::size_t band = 0; band < emission.size(); ++band)
    brightest = std::max(brightest, emission[band] * largest[channelOf(scene, band)]);
  return brightest;
}

/// The largest emission of a surface in any band. Edits leave materials behind that no surface uses.
double brightestEmission(const Scene& scene) {
  std::set<int> used;
  for (const Surface& surface : scene.surfaces) used.insert(surface.material);
  double brightest = 0;
  for (const int material : used)
    brightest = std::max(brightest, brightestEmission(scene, scene.materials[static_cast<std::size_t>(material)]));
  return brightest;
}

/// The largest emission, irradiance from outside, or intensity of a lamp in any band.
double brightestLight(const Scene& scene) {
  double largest = std::max(brightestEmission(scene), brightest(scene.outside));
  for (const Lamp& lamp : scene.lamps) largest = std::max(largest, largestBand(lamp.intensity));
  return largest;
}

/// The scene has no face with area. Throws InputError, which tells a scene without faces from one whose faces are too
/// small for the rounding of its coordinates.
[[noreturn]] void failEmpty(const PolygonMesh& mesh, const std::filesystem::path& file) {
  double coordinate = 0, size = 0;
  for (const MeshPolygon& polygon : mesh.polygons) {
    const glm::dvec3& first = mesh.positions[mesh.corners[polygon.firstCorner].position];
    for (std::uint32_t c = 0; c < polygon.cornerCount; ++c) {
      const glm::dvec3& corner = mesh.positions[mesh.corners[polygon.firstCorner + c].position];
      coordinate = std::max({coordinate, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
      size = std::max(size, glm::length(corner - first));
    }
  }
  constexpr double resolved = 1e-12;  // of the coordinates; above it some digits of a height are left
  if (size > 0 && size < resolved * coordinate)
    fail({file},
         "no face has an area above rounding: the largest one is " + raster::shortNumber(size) +
             " units across, at coordinates up to " + raster::shortNumber(coordinate),
         "move the scene to the origin, or scale its faces up");
  fail({file}, "the scene is empty: it has no face with area", "give a file with faces");
}

/// A polygon of n corners becomes n - 2 triangles, on each of its sides.
void requireMemoryFor(const PolygonMesh& mesh, const std::filesystem::path& file, Sides sides) {
  const std::uint64_t ofOneSide = mesh.corners.size() - std::min(mesh.corners.size(), 2 * mesh.polygons.size()),
                      triangles = sides == Sides::Two ? 2 * ofOneSide : ofOneSide;
  raster::requireMemory(triangles * bytesPerTriangle, file.string(),
                        "the scene of " + std::to_string(triangles) + " triangles", "divide it");
}

/// One sentence for each closed room whose walls keep nearly all light, so that it grows many times: the light is 1
/// over what they absorb. A room is a closed shell that is turned inside out. Maps count with the mean of their pixels.
void warnOfMirroredRooms(Scene& scene) {
  constexpr double mostReflected = 0.95;
  struct Room {
    double area = 0;
    Bands reflected = Bands(3);
    std::string brightest = {};  // the surface that reflects most
    double most = 0;
  };
  std::vector<Room> rooms(scene.shellVolumes.size());
  for (const Surface& surface : scene.surfaces) {
    const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    glm::dvec3 reflectance = material.reflectance;
    if (material.reflectanceMap)
      reflectance *= meanOf(scene.images[static_cast<std::size_t>(*material.reflectanceMap)]);
    for (const Triangle& triangle : surface.triangles) {
      const auto shell = static_cast<std::size_t>(std::abs(triangle.shell));
      if (shell == 0 || scene.shellVolumes[shell - 1] >= 0) continue;
      Room& room = rooms[shell - 1];
      const glm::dvec3 colour = (triangle.colour[0] + triangle.colour[1] + triangle.colour[2]) / 3.0F;
      const glm::dvec3 reflected = reflectance * colour;
      for (int band = 0; band < 3; ++band)
        room.reflected[static_cast<std::size_t>(band)] += reflected[band] * area(triangle);
      room.area += area(triangle);
      const double most = std::max({reflected.r, reflected.g, reflected.b});
      if (most > room.most) room.brightest = surface.name;
      room.most = std::max(room.most, most);
    }
  }
  for (const Room& room : rooms) {
    const double mean = *std::max_element(room.reflected.begin(), room.reflected.end()) / room.area;
    if (room.area > 0 && mean > mostReflected)
      scene.warnings.push_back("the closed room of `" + raster::excerpt(room.brightest) + "` reflects " +
                               raster::shortNumber(mean) + " of its light, which grows to " +
                               raster::shortNumber(1 / (1 - mean)) +
                               " times what is emitted; give its materials "
                               "lower reflectances if this is not meant");
  }
}

}  // namespace

Scene makeScene(PolygonMesh mesh, const MaterialSource& materials, const std::filesystem::path& file,
                const SceneSettings& settings) {
  if (!(settings.maxReflectance >= 0 && settings.maxReflectance < 1)) {
    throw raster::InputError("the largest reflectance must be at least 0 and below 1");
  }
  if (settings.facets && settings.sides == Sides::TwoOfSheets)
    throw raster::InputError("facets have one side each, or two each", "leave the sides of sheets out");
  requireMemoryFor(mesh, file, settings.sides);
  Scene scene;
  if (settings.facets) divideIntoFacets(mesh);
  const std::map<std::string, Material> ofFaces = divideByMaterials(mesh, settings, file);
  scene.faces = mesh.polygons.size();
  scene.warnings = mesh.warnings;
  scene.objects = mesh.objects;
  std::vector<Section> sections = cutIntoSections(mesh, settings.facets, scene.warnings);
  if (sections.empty()) failEmpty(mesh, file);

  const MaterialChoice choice = chooseMaterials(sections);
  MaterialSet found = ofFaces.empty() ? materials(choice.names) : materialsNamed(choice.names, ofFaces);
  scene.materials = std::move(found.materials);
  scene.images = std::move(found.images);
  fillHolesOfMaps(scene);
  scene.files = std::move(found.files);
  std::move(found.warnings.begin(), found.warnings.end(), std::back_inserter(scene.warnings));

  for (std::size_t s = 0; s < sections.size(); ++s) {
    const std::string family = sections[s].family;
    const auto object = static_cast<int>(sections[s].object);
    addSurfaces(scene, layCharts(std::move(sections[s]), mesh, file, settings), family, choice.ofSection[s], object);
  }
  flip(scene, settings.flip, file);
  if (settings.facets && hasCutOuts(scene))
    fail({file}, "facets have no holes, but its materials have cut-outs (docs/files.md)",
         "compute the matrix of its elements, or make the materials opaque");
  if (settings.sides == Sides::Two && settings.facets)
    addBacksOfFacets(scene);
  else if (settings.sides == Sides::Two)
    addBacks(scene, allSurfaces(scene));
  else if (const std::vector<std::uint32_t> cutOuts = doubleSidedCutOuts(scene); !cutOuts.empty())
    addBacks(scene, cutOuts);
  setSymmetry(scene, settings.symmetry);
  Contacts contacts = findContacts(scene);
  if (settings.sides == Sides::TwoOfSheets) {
    const std::vector<std::uint32_t> sheets = sheetsOf(scene, contacts);
    addBacks(scene, sheets);
    if (!sheets.empty()) contacts = findContacts(scene);
  }
  scene = resolved(std::move(scene), contacts);
  removeEmptySurfaces(scene);
  warnOfMirroredRooms(scene);
  makeNamesUnique(scene.surfaces);
  if (scene.extent < smallestExtent) fail({file}, "the scene is smaller than 1e-18 units", "scale it up");
  for (const std::vector<std::string>& warnings : {resolutionWarnings(scene), roundingWarnings(scene)})
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
  return scene;
}

Scene loadScene(const std::filesystem::path& file, const SceneSettings& settings) {
  refuseForeignFormat(file);
  if (isGltf(file)) {
    refuseCellData(file, cellDataOf(settings));
    const GltfFile gltf = readGltf(file);
    const auto materials = [&](const std::vector<std::string>& names) {
      return gltfMaterials(names, gltf, file, settings);
    };
    Scene scene = makeScene(gltf.mesh, materials, file, settings);
    scene.camera = gltf.camera;
    addLights(scene, gltf.lights, file, settings);
    scene.up = 1;
    scene.files.insert(scene.files.begin(), file);
    return scene;
  }
  PolygonMesh mesh = readMesh(file, cellDataOf(settings));
  std::optional<double> unnamed;
  if (isPlainMesh(file)) unnamed = grey;
  if (!mesh.colours.empty()) unnamed = settings.maxReflectance;
  const auto materials = [&, files = materialFiles(mesh, file.parent_path())](const std::vector<std::string>& names) {
    return findMaterials(names, files, settings, unnamed);
  };
  Scene scene = makeScene(std::move(mesh), materials, file, settings);
  scene.files.insert(scene.files.begin(), file);
  return scene;
}

PolygonMesh readFaces(const std::filesystem::path& file, Sides sides) {
  refuseForeignFormat(file);
  PolygonMesh faces = isGltf(file) ? readGltf(file).mesh : readMesh(file, {});
  return sides == Sides::Two ? withBacks(std::move(faces)) : faces;
}

PolygonMesh withBacks(PolygonMesh faces) {
  const std::size_t fronts = faces.polygons.size();
  for (std::size_t p = 0; p < fronts; ++p) {
    MeshPolygon back = faces.polygons[p];
    const auto first = faces.corners.begin() + back.firstCorner;
    const std::vector<MeshCorner> corners(first, first + back.cornerCount);
    back.firstCorner = static_cast<std::uint32_t>(faces.corners.size());
    faces.corners.insert(faces.corners.end(), corners.rbegin(), corners.rend());
    faces.polygons.push_back(back);
  }
  return faces;
}

bool isPlainMesh(const std::filesystem::path& file) { return meshFormatOf(file) != nullptr; }

bool emitsLight(const Scene& scene) { return brightestLight(scene) > 0; }

void requireEmission(const Scene& scene, const std::filesystem::path& file) {
  const double largest = brightestLight(scene);
  if (largest == 0)
    fail({file}, "nothing in the scene emits light", "give a material an emission (Ke in the MTL file)");
  if (largest < smallestEmission) fail({file}, "nothing in the scene emits 1e-30 or more", "scale the light up");
}

}  // namespace hemitex::radiosity
