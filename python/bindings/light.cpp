#include "python/bindings/light.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "python/bindings/arrays.h"
#include "python/bindings/form_factors.h"
#include "python/bindings/renderers.h"
#include "python/bindings/scenes.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/sensitivity.h"
#include "raster/base/parallel.h"

namespace hemitex::python {
namespace {

using raster::InputError;
using namespace py::literals;

radiosity::LightHooks hooksOf(const Method& method) {
  return {
      .layOut = [ids = method.ids](
                    const radiosity::Discretization& discretization) { return radiosity::layOut(discretization, ids); },
      .makeRenderer = method.makeRenderer,
      .rows = method.rows};
}

reference::RayRowSettings raySettings(const Settings& settings) {
  reference::RayRowSettings rays{.start = reference::RayStart::Area};
  assign(rays.rays, settings.integer("samples", 64, 1 << 24));
  if ((rays.rays & (rays.rays - 1)) != 0)
    throw InputError("`samples` is " + std::to_string(rays.rays), "give a power of two");
  rays.seed = static_cast<std::uint32_t>(settings.integer("seed", 0, std::numeric_limits<int>::max()).value_or(0));
  return rays;
}

/// The surfaces that a picture of 4 to 3 shows, as `hemitex solve` finds them.
std::vector<bool> seenBy(const radiosity::Scene& scene, const py::object& camera) {
  if (camera.is_none()) return {};
  const radiosity::Camera seenFrom = cameraOf(camera.cast<py::dict>());
  return unlocked([&] { return radiosity::seenSurfaces(scene, seenFrom, 256, 192); });
}

/// Chooses what bounds the error: that of rows between facets without texels, or the effort of the whole solution.
void setBound(Method& method, double bound, const Settings& settings, const Elements& elements,
              const py::object& camera) {
  if (method.rows) throw InputError("`max_error` chooses settings of hemicubes", "omit `method`");
  method.light.isResidualDefault = false;
  radiosity::LightSettings& light = method.light;
  const std::optional<double> residual = settings.number("residual", 1e-14, 1e300);
  const bool isResolutionGiven = settings.value("resolution").has_value();
  const bool isSplitGiven = settings.value("split").has_value();
  const bool areElements =
      std::ranges::all_of(elements.discretization.grids, [](const auto& grid) { return grid.elementCount == 1; });
  if (!elements.facets || !areElements) {
    light.maxError = bound;
    light.seen = seenBy(*elements.scene, camera);
    light.residual = residual;
    if (isResolutionGiven) light.coarsest.resolution = light.drawing.resolution;
    if (isSplitGiven) light.coarsest.split = light.drawing.split;
    return;
  }
  if (isResolutionGiven || isSplitGiven)
    throw InputError("`max_error` chooses settings of rows between facets", "omit `resolution` and `split`");
  method.rows = reference::boundedRows(bound, method.errors);
  light.solver.residual = std::min(radiosity::residualFor(bound), residual.value_or(1));
}

Method methodOf(const Settings& settings, const Elements& elements, const py::object& camera,
                const py::object& makeRenderer) {
  Method method{.ids = idSettings(settings), .makeRenderer = rendererFactory(makeRenderer)};
  if (settings.text("method").value_or("") == "rays")
    method.rows = reference::rayRows(raySettings(settings));
  else
    method.light.drawing = drawingSettings(settings, {"rays"});
  radiosity::SolverSettings& solver = method.light.solver;
  solver.shots = settings.integer("shots", 0, std::numeric_limits<int>::max());
  const std::optional<double> residual = settings.number("residual", 1e-14, 1e300);
  solver.residual = residual.value_or(solver.residual);
  method.light.isResidualDefault = !residual;
  if (const auto bound = settings.number("max_error", 1e-6, 1)) setBound(method, *bound, settings, elements, camera);
  method.light.elements = elements.settings;
  return method;
}

/// How far a solution is: the logarithm of its residual is nearly linear in shots.
double shareDone(const radiosity::Step& step, const radiosity::SolverSettings& settings) {
  if (settings.shots)
    return *settings.shots == 0 ? 1 : static_cast<double>(step.shots) / static_cast<double>(*settings.shots);
  if (!(step.residual > settings.residual)) return 1;
  return std::clamp(std::log(step.residual) / std::log(std::min(settings.residual, 0.5)), 0.0, 1.0);
}

radiosity::Progress progressOf(Progress& told, const radiosity::SolverSettings& settings) {
  return [&told, &settings](const radiosity::Step& step) { return told.tell(shareDone(step, settings)); };
}

/// A copy without what edits go on from.
SharedSolution resultOf(const radiosity::Solution& solution) {
  return std::make_shared<const radiosity::Solution>(radiosity::Solution{.radiosity = solution.radiosity,
                                                                         .radiosityInBands = solution.radiosityInBands,
                                                                         .irradiance = solution.irradiance,
                                                                         .ambient = solution.ambient,
                                                                         .energy = solution.energy,
                                                                         .patches = {},
                                                                         .absorbedByBacks = solution.absorbedByBacks,
                                                                         .residual = solution.residual,
                                                                         .shots = solution.shots,
                                                                         .isInterrupted = solution.isInterrupted,
                                                                         .warnings = solution.warnings});
}

std::shared_ptr<Solved> solve(const SharedElements& elements, const py::dict& given, const py::object& camera,
                              const py::object& makeRenderer, py::object progress) {
  const Settings settings(given);
  const radiosity::Scene& scene = *elements->scene;
  if (scene.files.empty() && !radiosity::emitsLight(scene))
    throw InputError("nothing in the scene emits light", "give `emission` to from_arrays, or edit it with SetEmission");
  radiosity::requireEmission(scene, scene.files.empty() ? std::filesystem::path("the scene") : scene.files.front());
  auto solved = std::make_shared<Solved>();
  Method& method = solved->method;
  method = methodOf(settings, *elements, camera, makeRenderer);
  const bool isEditable = settings.flag("editable").value_or(false);
  if (isEditable && !elements->settings.isUnburied)
    throw InputError("the elements leave out what solids cover, which edits may uncover",
                     "give editable=True to discretize, too");
  method.light.isContinued = isEditable;
  Progress told(std::move(progress));
  unlocked([&] {
    radiosity::LightHooks hooks = hooksOf(method);
    hooks.start = [&](const radiosity::SolverSettings& used) {
      return radiosity::SolutionStart{.progress = progressOf(told, used)};
    };
    radiosity::Light light = radiosity::light(scene, elements->discretization, method.light, hooks);
    if (method.light.maxError && !light.expectedErrors && light.solution.isInterrupted)
      throw InputError("the progress callback ended the choice of settings");
    method.light = light.settings;
    solved->expectedErrors = light.expectedErrors;
    if (!isEditable) {
      solved->elements = std::make_shared<const Elements>(
          Elements{elements->scene, elements->facets, elements->settings, std::move(light.discretization)});
      solved->solution = std::make_shared<const radiosity::Solution>(std::move(light.solution));
      return;
    }
    solved->elements = std::make_shared<const Elements>(
        Elements{elements->scene, elements->facets, elements->settings, light.discretization});
    solved->solution = resultOf(light.solution);
    solved->dynamic = std::make_unique<radiosity::DynamicSolution>(radiosity::editable(scene, std::move(light), hooks));
  });
  return solved;
}

/// The edited solution, to which what edits go on from moves, and the cost.
py::tuple edit(Solved& solved, const py::sequence& list, py::object progress) {
  const std::vector<radiosity::Edit> edits = editsOf(list);
  const std::unique_lock locked(solved.mutex, std::try_to_lock);
  if (!locked) throw InputError("another thread edits this solution");
  if (solved.isEdited) throw InputError("the solution was edited before", "edit the solution that this gave");
  if (!solved.dynamic)
    throw InputError("the solution keeps nothing to edit", "give editable=True to discretize and to solve");
  Progress told(std::move(progress));
  auto edited = std::make_shared<Solved>();
  edited->method = solved.method;
  const radiosity::UpdateCost cost = unlocked([&] {
    const radiosity::UpdateCost spent = solved.dynamic->update(edits, progressOf(told, solved.method.light.solver));
    const radiosity::DynamicSolution& now = *solved.dynamic;
    edited->elements = std::make_shared<const Elements>(Elements{
        std::make_shared<const radiosity::Scene>(now.scene()), false, solved.elements->settings, now.discretization()});
    edited->solution = resultOf(now.solution());
    return spent;
  });
  edited->dynamic = std::move(solved.dynamic);
  solved.isEdited = true;
  py::dict spent("rows_in_windows"_a = cost.rowsInWindows, "rows_whole"_a = cost.rowsWhole,
                 "rows_retracted"_a = cost.rowsRetracted, "rows_left"_a = cost.rowsLeft,
                 "started_over"_a = cost.startedOver);
  return py::make_tuple(edited, spent);
}

std::vector<std::string> textsOf(const std::vector<radiosity::SolutionWarning>& warnings) {
  std::vector<std::string> texts;
  for (const radiosity::SolutionWarning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

py::dict aboutSolution(const Solved& solved) {
  const radiosity::Energy& energy = solved.solution->energy;
  const bool areWavelengths = !solved.elements->scene->wavelengths.empty();
  const auto listed = [&](const radiosity::Bands& inSquareUnits) {
    radiosity::Bands flux = radiosity::scaled(inSquareUnits, solved.elements->scene->squareMetres);
    if (areWavelengths) std::ranges::reverse(flux);
    return py::tuple(py::cast(flux));
  };
  py::dict about("shots"_a = solved.solution->shots, "residual"_a = solved.solution->residual,
                 "ended_by"_a = endOf(*solved.solution, solved.method.light.solver),
                 "interrupted"_a = solved.solution->isInterrupted, "warnings"_a = textsOf(solved.solution->warnings),
                 "ambient"_a = toTuple(solved.solution->ambient),
                 "patches"_a = solved.elements->discretization.patches.list.size(),
                 "energy"_a = py::dict("emitted"_a = listed(energy.emitted), "absorbed"_a = listed(energy.absorbed),
                                       "unshot"_a = listed(energy.unshot), "lost"_a = listed(energy.lost),
                                       "lost_to_backs"_a = listed(energy.lostToBacks)));
  const std::vector<double>& errors = *solved.method.errors;
  about["expected_error"] = solved.expectedErrors ? std::optional(solved.expectedErrors->larger()) : std::nullopt;
  about["row_error"] = errors.empty() ? std::nullopt : std::optional(*std::ranges::max_element(errors));
  return about;
}

/// The derivatives of targets, each an array of weights.
py::list sensitivitiesOf(const Solved& solved, const py::list& targets, py::object progress) {
  const SharedElements elements = solved.elements;
  if (!elements->scene->wavelengths.empty())
    throw InputError("sensitivities are those of red, green and blue", "solve the scene without in_bands");
  const auto count = static_cast<py::ssize_t>(elements->discretization.elements.size());
  std::vector<std::vector<glm::dvec3>> weights;
  for (const py::handle& target : targets) weights.push_back(vectorsOf(numbers(target, "target", {count, 3})));
  Progress told(std::move(progress));
  std::vector<radiosity::Sensitivity> found = unlocked([&] {
    const auto tell = [&](std::size_t done, std::size_t all) {
      told.tell(static_cast<double>(done) / static_cast<double>(all));
    };
    std::vector<radiosity::Sensitivity> ofTargets;
    radiosity::LightHooks hooks = hooksOf(solved.method);
    hooks.solve = [&](const radiosity::SolveInput& input) {
      ofTargets = radiosity::sensitivities(input, weights, tell);
      return radiosity::Solution();
    };
    radiosity::light(*elements->scene, elements->discretization, {.drawing = solved.method.light.drawing}, hooks);
    return ofTargets;
  });
  py::list result;
  for (radiosity::Sensitivity& each : found)
    result.append(py::dict("target"_a = toTuple(each.target), "by_emission"_a = toArray(std::move(each.byEmission)),
                           "by_reflectance"_a = toArray(std::move(each.byReflectance)),
                           "radiosity"_a = toArray(std::move(each.radiosity))));
  return result;
}

/// Limits the threads of all calls while it lives.
class Threads {
 public:
  explicit Threads(int threads) : limit_(threads) {}

 private:
  raster::ThreadLimit limit_;
};

}  // namespace

radiosity::Camera cameraOf(const py::dict& dictionary) {
  const auto vector = [&](const char* name) { return vectorOf(py::object(dictionary[name]), name); };
  radiosity::Camera camera{.eye = vector("eye"), .lookAt = vector("look_at"), .up = vector("up")};
  assign(camera.fov, Settings(dictionary).number("fov", 1e-9, 180 - 1e-9));
  return camera;
}

void addLight(py::module_& module) {
  py::class_<Solved, std::shared_ptr<Solved>>(module, "Solution");
  module.def("solve", &solve);
  module.def("edit_solution", &edit);
  module.def("about_solution", &aboutSolution);
  module.def("sensitivities", &sensitivitiesOf);
  module.def("elements_of", [](const Solved& solved) { return std::const_pointer_cast<Elements>(solved.elements); });
  module.def("radiosity", [](const Solved& solved) {
    return sharedArray(std::shared_ptr<const std::vector<glm::dvec3>>(solved.solution, &solved.solution->radiosity));
  });
  // By ascending wavelengths; without wavelengths none.
  module.def("radiosity_in_bands", [](const Solved& solved) {
    const radiosity::BandTable& table = solved.solution->radiosityInBands;
    std::vector<double> values = table.values;
    for (std::size_t e = 0; e < table.size(); ++e)
      std::reverse(values.begin() + static_cast<std::ptrdiff_t>(e * table.bands),
                   values.begin() + static_cast<std::ptrdiff_t>((e + 1) * table.bands));
    return toArray(std::move(values), {static_cast<py::ssize_t>(table.size()), static_cast<py::ssize_t>(table.bands)});
  });
  py::class_<Threads>(module, "Threads").def(py::init([](const py::object& threads) {
    return new Threads(static_cast<int>(integerOf(threads, "threads", 0, 1 << 16)));
  }));
}

}  // namespace hemitex::python
