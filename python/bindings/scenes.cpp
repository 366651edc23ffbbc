#include "python/bindings/scenes.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "python/bindings/arrays.h"
#include "python/bindings/settings.h"
#include "radiosity/bands/spectral_scene.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/meshes/length_unit.h"
#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/meshes/vtu_file.h"
#include "radiosity/pictures/default_camera.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/materials.h"
#include "radiosity/scene/mtl_file.h"
#include "raster/base/lower_case.h"

namespace hemitex::python {
namespace {

using radiosity::Scene;
using radiosity::Surface;
using raster::InputError;

constexpr std::int64_t maxCount = (std::int64_t{1} << 31) - 1;

/// `mirrors` are pairs of an axis and a coordinate.
radiosity::Symmetry symmetryOf(const Settings& settings) {
  radiosity::Symmetry symmetry;
  if (const auto mirrors = settings.value("mirrors"))
    for (const py::handle& mirror : *mirrors) {
      const auto pair = py::reinterpret_borrow<py::sequence>(mirror);
      const std::size_t axis = !py::isinstance<py::sequence>(mirror) || pair.size() != 2
                                   ? std::string::npos
                                   : std::string("x,y,z").find(textOf(pair[0], "mirrors"));
      if (axis == std::string::npos || axis % 2 == 1)
        throw InputError("`mirrors` is no list of pairs", "give (axis, coordinate) for each; the axis is x, y or z");
      symmetry.mirrors[axis / 2].push_back(numbers(pair[1], "mirrors", {}).values[0]);
    }
  if (const auto period = settings.value("period")) symmetry.period = vectorOf(*period, "period");
  assign(symmetry.repeats, settings.integer("repeats", 1, 1000));
  return symmetry;
}

radiosity::SceneSettings sceneSettings(const Settings& settings) {
  using radiosity::Charts, radiosity::EmissionUnit, radiosity::Sides;
  radiosity::SceneSettings result{.sides = Sides::TwoOfSheets};
  assign(result.charts, settings.choice<Charts>(
                            "charts", {{"auto", Charts::Auto}, {"file", Charts::File}, {"planar", Charts::Planar}}));
  result.crease = settings.number("crease", 1e-9, 180);
  assign(result.maxReflectance, settings.number("max_reflectance", 0, 1 - 1e-16));
  assign(result.lumensPerWatt, settings.number("lumens_per_watt", 1e-30, 1e30));
  assign(result.sides,
         settings.choice<Sides>("sides", {{"auto", Sides::TwoOfSheets}, {"one", Sides::One}, {"two", Sides::Two}}));
  assign(result.emission, settings.choice<EmissionUnit>("emission", {{"radiosity", EmissionUnit::Radiosity},
                                                                     {"radiance", EmissionUnit::Radiance}}));
  assign(result.facets, settings.flag("facets"));
  if (result.facets && result.sides == Sides::TwoOfSheets) result.sides = Sides::One;
  if (const auto names = settings.value("flip"))
    for (const py::handle& name : py::reinterpret_borrow<py::sequence>(*names))
      result.flip.push_back(textOf(name, "flip"));
  result.symmetry = symmetryOf(settings);
  return result;
}

/// Facets lose what is inside solids; other surfaces are separated at walls.
std::shared_ptr<const Scene> shared(Scene scene, const radiosity::SceneSettings& settings) {
  return std::make_shared<const Scene>(settings.facets ? radiosity::withoutBuried(std::move(scene))
                                                       : radiosity::separatedAtWalls(std::move(scene)));
}

PythonScene loadScene(const std::filesystem::path& file, const py::dict& given) {
  const radiosity::SceneSettings settings = sceneSettings(Settings(given));
  return {unlocked([&] {
            Scene scene = radiosity::loadScene(file, settings);
            const double metres = radiosity::statedMetresPerUnit(file, scene.warnings).value_or(1);
            scene.squareMetres = metres * metres;
            return shared(std::move(scene), settings);
          }),
          settings.facets};
}

/// The mesh of faces, of which each belongs to a section: a group with a material, whose name is its number.
radiosity::PolygonMesh meshOf(const Array<double>& vertices, const Array<std::int64_t>& corners,
                              const Array<std::int64_t>& counts, const Array<std::int64_t>& groupOf,
                              const Array<std::int64_t>& materialOf, const std::vector<std::string>& groups) {
  const std::filesystem::path name = "arrays";
  const radiosity::Place place{name, 0};
  radiosity::PolygonMesh mesh;
  for (const glm::dvec3& vertex : vectorsOf(vertices)) radiosity::addPosition(mesh, vertex, place);
  for (const std::string& group : groups) mesh.objects.push_back({group});
  std::map<std::pair<std::int64_t, std::int64_t>, std::uint32_t> sections;
  std::size_t first = 0;
  for (std::size_t f = 0; f < counts.length(); ++f) {
    const auto count = static_cast<std::size_t>(counts.values[f]);
    if (count > corners.length() - first) throw InputError("`faces` has fewer corners than its counts say");
    const auto [section, isNew] = sections.try_emplace({groupOf.values[f], materialOf.values[f]},
                                                       static_cast<std::uint32_t>(mesh.sections.size()));
    if (isNew)
      mesh.sections.push_back({static_cast<std::uint32_t>(groupOf.values[f]), std::to_string(materialOf.values[f])});
    std::vector<std::uint32_t> polygon;
    for (std::size_t c = first; c < first + count; ++c)
      polygon.push_back(static_cast<std::uint32_t>(corners.values[c]));
    radiosity::addPolygon(mesh, polygon, place);
    mesh.polygons.back().section = section->second;
    first += count;
  }
  return mesh;
}

/// Materials by their numbers, made valid as those of files are.
radiosity::MaterialSet materialsNamed(const std::vector<std::string>& names, const std::vector<glm::dvec3>& reflectance,
                                      const std::vector<glm::dvec3>& emission,
                                      const radiosity::SceneSettings& settings) {
  radiosity::MaterialSet set;
  for (const std::string& name : names) {
    const auto m = static_cast<std::size_t>(std::stoull(name));
    radiosity::Material material{name, reflectance[m], emission[m] * radiosityPerUnit(settings.emission)};
    for (int band = 0; band < 3; ++band) {
      if (material.reflectance[band] < 0) throw InputError("a reflectance is below 0");
      if (material.emission[band] < 0) throw InputError("an emission is below 0");
      if (material.emission[band] > radiosity::largestEmission)
        throw InputError("an emission is above 1e30 W/m^2", "scale it down");
    }
    if (const auto warning = radiosity::lowerReflectance(material.reflectance, settings.maxReflectance))
      set.warnings.push_back("material " + name + ": " + *warning);
    set.materials.push_back(material);
  }
  return set;
}

PythonScene sceneFromArrays(const py::object& vertices, const py::object& corners, const py::object& counts,
                            const py::object& groupOf, const py::object& materialOf,
                            const std::vector<std::string>& groups, const py::object& reflectance,
                            const py::object& emission, const py::dict& given) {
  const radiosity::SceneSettings settings = sceneSettings(Settings(given));
  const Array<double> points = numbers(vertices, "vertices", {-1, 3});
  if (points.shape[0] > maxCount) throw InputError("`vertices` has more than 2^31 rows");
  const Array<std::int64_t> faceCounts = integers(counts, "faces", {-1}, 3, maxCount);
  const auto faces = faceCounts.shape[0];
  const Array<std::int64_t> indices = integers(corners, "faces", {-1}, 0, points.shape[0] - 1);
  const Array<std::int64_t> group =
      integers(groupOf, "names", {faces}, 0, static_cast<std::int64_t>(groups.size()) - 1);
  const Array<double> rho = numbers(reflectance, "reflectance", {-1, 3}),
                      light = numbers(emission, "emission", {-1, 3});
  const Array<std::int64_t> material =
      integers(materialOf, "reflectance", {faces}, 0, std::min(rho.shape[0], light.shape[0]) - 1);
  const auto mesh =
      std::make_shared<const radiosity::PolygonMesh>(meshOf(points, indices, faceCounts, group, material, groups));
  const std::vector<glm::dvec3> reflectances = vectorsOf(rho), emissions = vectorsOf(light);
  return {unlocked([&] {
            const auto named = [&](const std::vector<std::string>& names) {
              return materialsNamed(names, reflectances, emissions, settings);
            };
            return shared(radiosity::makeScene(*mesh, named, "arrays", settings), settings);
          }),
          settings.facets,
          {},
          settings.facets ? mesh : nullptr};
}

PythonScene editedScene(const PythonScene& former, const py::sequence& list) {
  const std::vector<radiosity::Edit> edits = editsOf(list);
  return unlocked([&] {
    radiosity::EditedScene edit = radiosity::edited(*former.scene, former.removed, edits);
    return PythonScene{std::make_shared<const Scene>(std::move(edit.scene)), former.facets, std::move(edit.removed)};
  });
}

/// Light of at least 0.
glm::dvec3 lightOf(const py::object& value, const char* name) {
  const glm::dvec3 light = vectorOf(value, name);
  for (int band = 0; band < 3; ++band)
    if (!(light[band] >= 0 && light[band] <= radiosity::largestEmission))
      throw InputError("`" + std::string(name) + "` has light below 0 or above 1e30");
  return light;
}

/// Pairs of a vector and light.
std::vector<std::pair<glm::dvec3, glm::dvec3>> lightsOf(const py::sequence& list, const char* name,
                                                        const std::string& advice) {
  std::vector<std::pair<glm::dvec3, glm::dvec3>> lights;
  for (const py::handle& entry : list) {
    const auto pair = py::reinterpret_borrow<py::sequence>(entry);
    if (!py::isinstance<py::sequence>(entry) || pair.size() != 2)
      throw InputError("`" + std::string(name) + "` is no list of pairs", advice);
    lights.emplace_back(vectorOf(py::object(pair[0]), name), lightOf(py::object(pair[1]), name));
  }
  return lights;
}

/// The scene with light that no surface emits: `suns` are pairs of a direction and an irradiance, `lamps` of a point
/// and an intensity. With `isMore` they are added to those of the scene; else there are no other suns.
PythonScene withLight(const PythonScene& former, const py::object& sky, const py::sequence& suns,
                      const py::sequence& lamps, bool isMore) {
  Scene scene = *former.scene;
  if (!isMore) scene.outside.suns.clear();
  scene.outside.sky = lightOf(sky, "sky");
  for (const auto& [towards, irradiance] : lightsOf(suns, "suns", "give (direction, irradiance) for each")) {
    const double longest = radiosity::largestBand(glm::abs(towards));
    if (longest == 0) throw InputError("`suns` has a direction of length 0");
    scene.outside.suns.push_back({glm::normalize(towards / longest), irradiance});
  }
  for (const auto& [position, intensity] : lightsOf(lamps, "lamps", "give (position, intensity) for each"))
    scene.lamps.push_back({"lamp-" + std::to_string(scene.lamps.size() + 1), position, intensity});
  PythonScene lit = former;
  lit.scene = std::make_shared<const Scene>(std::move(scene));
  return lit;
}

/// The scene in bands. `spectra` has a dictionary for each material, with lists named `reflectance` and `emission`.
PythonScene inBands(const PythonScene& former, const py::object& wavelengths, const py::dict& spectra) {
  const auto listOf = [](const Array<double>& array) {
    return std::vector<double>(array.values.begin(), array.values.end());
  };
  radiosity::SpectralBands bands{listOf(numbers(wavelengths, "wavelengths", {-1})), {}};
  const auto count = static_cast<py::ssize_t>(bands.wavelengths.size());
  for (const auto& [name, quantities] : spectra) {
    radiosity::MaterialSpectra& found = bands.materials[textOf(name, "name")];
    if (!py::isinstance<py::dict>(quantities)) throw InputError("`spectra` has no dictionary for each material");
    for (const auto& [key, values] : quantities.cast<py::dict>()) {
      const std::string quantity = textOf(key, "quantity");
      if (quantity != "reflectance" && quantity != "emission")
        throw InputError("`" + raster::excerpt(quantity) + "` is no quantity",
                         "the quantities are reflectance and emission");
      (quantity == "reflectance" ? found.reflectance : found.emission) =
          radiosity::Spectrum{bands.wavelengths, listOf(numbers(values, quantity, {count}))};
    }
  }
  requireValid(bands, *former.scene);
  constexpr double maxReflectance = radiosity::SceneSettings().maxReflectance;
  return {std::make_shared<const Scene>(radiosity::inBands(*former.scene, bands, maxReflectance)), former.facets,
          former.removed};
}

py::dict cameraDict(const radiosity::Camera& camera) {
  using namespace py::literals;
  return py::dict("eye"_a = toTuple(camera.eye), "look_at"_a = toTuple(camera.lookAt), "up"_a = toTuple(camera.up),
                  "fov"_a = camera.fov);
}

const radiosity::Material& materialOf(const Scene& scene, const Surface& surface) {
  return scene.materials[static_cast<std::size_t>(surface.material)];
}

/// Values of all surfaces, one per surface.
template <typename Value>
py::array_t<double> ofSurfaces(const Scene& scene, const Value& value) {
  std::vector<std::decay_t<decltype(value(scene.surfaces.front()))>> values;
  for (const Surface& surface : scene.surfaces) values.push_back(value(surface));
  return toArray(std::move(values));
}

py::dict aboutScene(const PythonScene& scene) {
  using namespace py::literals;
  const Scene& of = *scene.scene;
  py::list names, families, materials, files, lamps;
  for (const radiosity::Lamp& lamp : of.lamps)
    lamps.append(py::make_tuple(lamp.name, toTuple(lamp.position), toTuple(lamp.intensity)));
  for (const Surface& surface : of.surfaces) {
    names.append(surface.name);
    families.append(surface.family);
    materials.append(materialOf(of, surface).name);
  }
  for (const std::filesystem::path& file : of.files) files.append(file.string());
  return py::dict(
      "names"_a = names, "families"_a = families, "materials"_a = materials, "files"_a = files,
      "warnings"_a = py::cast(of.warnings), "origin"_a = toTuple(of.origin), "extent"_a = of.extent,
      "faces"_a = of.faces, "sky"_a = toTuple(of.outside.sky), "lamps"_a = lamps,
      "wavelengths"_a = py::cast(std::vector<double>(of.wavelengths.rbegin(), of.wavelengths.rend())),
      "area"_a = ofSurfaces(of, [](const Surface& surface) { return radiosity::area(surface); }),
      "reflectance"_a = ofSurfaces(of, [&](const Surface& surface) { return materialOf(of, surface).reflectance; }),
      "emission"_a = ofSurfaces(of, [&](const Surface& surface) { return materialOf(of, surface).emission; }),
      "camera"_a = of.camera ? py::object(cameraDict(*of.camera)) : py::object(py::none()));
}

py::tuple trianglesOf(const PythonScene& scene) {
  std::vector<double> corners;
  std::vector<std::int64_t> surfaces;
  for (std::size_t s = 0; s < scene.scene->surfaces.size(); ++s)
    for (const radiosity::Triangle& triangle : scene.scene->surfaces[s].triangles) {
      for (const glm::dvec3& corner : triangle.position) corners.insert(corners.end(), {corner.x, corner.y, corner.z});
      surfaces.push_back(static_cast<std::int64_t>(s));
    }
  const auto count = static_cast<py::ssize_t>(surfaces.size());
  return py::make_tuple(toArray(std::move(corners), {count, 3, 3}), toArray(std::move(surfaces)));
}

/// Writes the facets of a scene with arrays of values by their names.
void writeFacets(const std::filesystem::path& file, const PythonScene& scene, const py::dict& values) {
  if (raster::endingOf(file) != ".vtu")
    throw InputError("the name of a file for ParaView does not end in .vtu", "rename it");
  if (!scene.facets) throw InputError("the scene has no facets", "load it with facets=True, or make it without names");
  if (!scene.mesh && scene.scene->files.empty())
    throw InputError("the scene was edited", "give the one that it was made of");
  const std::size_t count = radiosity::facetsOf(*scene.scene).names.size();
  std::vector<radiosity::FaceArray> arrays;
  for (const auto& [name, array] : values) {
    const Array<double> found = numbers(array, textOf(name, "name"), {static_cast<py::ssize_t>(count)});
    arrays.push_back({textOf(name, "name"), 1, {found.values.begin(), found.values.end()}});
  }
  unlocked([&] {
    radiosity::PolygonMesh mesh = scene.mesh ? *scene.mesh : radiosity::readFaces(scene.scene->files.front());
    if (2 * mesh.polygons.size() == count) mesh = radiosity::withBacks(std::move(mesh));
    if (mesh.polygons.size() != count)
      throw InputError(scene.scene->files.front().string(), 0, "has other facets than when it was loaded",
                       "load it again");
    radiosity::writeVtu(file, mesh, arrays);
  });
}

radiosity::DiscretizationSettings discretizationSettings(const Settings& settings, const Scene& scene, bool facets) {
  radiosity::DiscretizationSettings result;
  result.texels = settings.integer("texels", 1, 4096);
  result.texelSize = settings.number("texel_size", std::numeric_limits<double>::min(), 1e300);
  if (result.texels && result.texelSize)
    throw InputError("both `texels` and `texel_size` are given", "omit one of them");
  assign(result.patch, settings.integer("patch", 1, 4096));
  assign(result.isUnburied, settings.flag("unburied"));
  if (const auto texels = settings.value("surface_texels")) {
    if (!py::isinstance<py::dict>(*texels)) throw InputError("`surface_texels` is no dictionary");
    for (const auto& [name, count] : py::reinterpret_borrow<py::dict>(*texels))
      result.surfaceTexels[textOf(name, "surface_texels")] =
          static_cast<int>(integerOf(count, "surface_texels", 1, 4096));
  }
  for (const auto& [name, texels] : result.surfaceTexels) radiosity::surfacesNamed(scene, name);
  if (facets) result.isUnburied = true;
  if (facets && !result.texels && !result.texelSize) result.texels = 1;
  return result;
}

SharedElements discretized(const PythonScene& scene, const py::dict& given) {
  const auto settings = discretizationSettings(Settings(given), *scene.scene, scene.facets);
  return unlocked([&] {
    return std::make_shared<const Elements>(
        Elements{scene.scene, scene.facets, settings, radiosity::discretize(*scene.scene, settings)});
  });
}

py::dict aboutElements(const Elements& elements) {
  using namespace py::literals;
  const radiosity::Discretization& discretization = elements.discretization;
  std::vector<std::int64_t> surface, column, row, patch;
  std::vector<double> area;
  for (const radiosity::Element& element : discretization.elements) {
    const auto columns = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
    surface.push_back(element.surface);
    column.push_back(element.texel % columns);
    row.push_back(element.texel / columns);
    area.push_back(element.area);
  }
  for (const std::uint32_t each : discretization.patches.ofElement) patch.push_back(each);
  std::vector<glm::dvec3> reflectances, emissions;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    reflectances.push_back(radiosity::reflectance(*elements.scene, discretization, e));
    emissions.push_back(radiosity::emission(*elements.scene, discretization, e));
  }
  return py::dict("surface"_a = toArray(std::move(surface)), "column"_a = toArray(std::move(column)),
                  "row"_a = toArray(std::move(row)), "area"_a = toArray(std::move(area)),
                  "patch"_a = toArray(std::move(patch)), "reflectance"_a = toArray(std::move(reflectances)),
                  "emission"_a = toArray(std::move(emissions)));
}

/// Centres and normals, as `hemitex solve` writes them into elements.csv.
py::tuple placesOf(const Elements& elements) {
  const radiosity::Discretization& discretization = elements.discretization;
  std::vector<glm::dvec3> centres, normals;
  unlocked([&] {
    const auto placeOf = radiosity::elementPlaces(*elements.scene, discretization);
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
      const radiosity::SurfacePoint place = placeOf(e);
      centres.push_back(place.position);
      normals.push_back(place.normal);
    }
  });
  return py::make_tuple(toArray(std::move(centres)), toArray(std::move(normals)));
}

/// The number of the element of each texel of a surface, -1 where it has no area.
py::array_t<std::int64_t> gridOf(const Elements& elements, const py::object& surface) {
  const auto last = static_cast<std::int64_t>(elements.scene->surfaces.size()) - 1;
  const auto number = static_cast<std::size_t>(integerOf(surface, "surface", 0, last));
  const radiosity::Grid& grid = elements.discretization.grids[number];
  std::vector<std::int64_t> numbers;
  for (std::size_t t = 0; t < grid.elementOfTexel.size(); ++t)
    numbers.push_back(grid.covered[t] ? std::int64_t{grid.elementOfTexel[t]} : -1);
  return toArray(std::move(numbers), {grid.rows, grid.columns});
}

}  // namespace

radiosity::Families familiesOf(const Elements& elements) {
  return elements.facets ? radiosity::facetsOf(*elements.scene) : radiosity::familiesOf(*elements.scene);
}

std::vector<radiosity::Edit> editsOf(const py::sequence& list) {
  std::vector<radiosity::Edit> edits;
  for (const py::handle& entry : list) {
    const auto edit = py::reinterpret_borrow<py::sequence>(entry);
    const std::string kind = textOf(py::object(edit[0]), "edit"), name = textOf(py::object(edit[1]), "name");
    const auto vector = [&] { return vectorOf(py::object(edit[2]), kind); };
    if (kind == "move") edits.push_back(radiosity::Move{name, vector()});
    if (kind == "remove") edits.push_back(radiosity::Remove{name});
    if (kind == "restore") edits.push_back(radiosity::Restore{name});
    if (kind == "add") edits.push_back(radiosity::Add{name, {.sides = radiosity::Sides::TwoOfSheets}, vector()});
    if (kind == "emission") edits.push_back(radiosity::SetEmission{name, vector()});
    if (kind == "reflectance") edits.push_back(radiosity::SetReflectance{name, vector()});
  }
  return edits;
}

void addScenes(py::module_& module) {
  py::class_<PythonScene>(module, "Scene");
  py::class_<Elements, std::shared_ptr<Elements>>(module, "Elements").def("__len__", [](const Elements& elements) {
    return elements.discretization.elements.size();
  });
  module.def("load_scene", &loadScene);
  module.def("scene_from_arrays", &sceneFromArrays);
  module.def("edit_scene", &editedScene);
  module.def("with_light", &withLight);
  module.def("in_bands", &inBands);
  module.def("about_scene", &aboutScene);
  module.def("triangles", &trianglesOf);
  module.def("write_facets", &writeFacets);
  module.def("default_camera", [](const PythonScene& scene) {
    return cameraDict(unlocked([&] { return radiosity::defaultCamera(*scene.scene); }));
  });
  module.def("discretize", [](const PythonScene& scene, const py::dict& settings) {
    return std::const_pointer_cast<Elements>(discretized(scene, settings));
  });
  module.def("about_elements", &aboutElements);
  module.def("places", &placesOf);
  module.def("grid", &gridOf);
  module.def("surfaces_named", [](const Elements& elements, const py::object& name) {
    return radiosity::surfacesNamed(*elements.scene, textOf(name, "name"));
  });
  module.def("families", [](const Elements& elements) { return familiesOf(elements).names; });
  module.def("scene_of", [](const Elements& elements) { return PythonScene{elements.scene, elements.facets}; });
}

}  // namespace hemitex::python
