/// Solutions by progressive refinement for JavaScript, shot by shot and with edits; web/page/core.ts has the types.
#include "web/bindings/light.h"

#include <emscripten.h>
#include <emscripten/bind.h>

#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "radiosity/bands/element_table.h"
#include "radiosity/base/csv_table.h"
#include "radiosity/light/light.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/shooting_state.h"
#include "raster/base/input_error.h"
#include "web/bindings/values.h"

namespace hemitex::web {
namespace {

using raster::InputError;

radiosity::Edit editOf(const Json& edit) {
  const std::string kind = edit.at("edit"), name = edit.at("name");
  if (kind == "move") return radiosity::Move{name, vectorOf(edit.at("by"))};
  if (kind == "remove") return radiosity::Remove{name};
  if (kind == "restore") return radiosity::Restore{name};
  if (kind == "emission") return radiosity::SetEmission{name, vectorOf(edit.at("to"))};
  if (kind == "reflectance") return radiosity::SetReflectance{name, vectorOf(edit.at("to"))};
  throw InputError("there is no edit `" + raster::excerpt(kind) + "`");
}

std::vector<radiosity::Edit> editsOf(const Json& list) {
  std::vector<radiosity::Edit> edits;
  for (const Json& edit : list) edits.push_back(editOf(edit));
  return edits;
}

/// Ends a solution after a number of shots. The solver asks after each shot.
radiosity::Progress atMost(int shots) {
  if (shots < 1) throw InputError("the number of shots is below 1");
  return [shots](const radiosity::Step& step) { return step.shots < shots; };
}

/// A solution. One that is editable continues in place.
class SolutionHandle {
 public:
  SolutionHandle(const ElementsHandle& elements, const Json& settings)
      : elements_(elements), drawing_(drawingSettings(settings)), ids_(idSettings(settings)) {
    radiosity::requireEmission(*elements.scene, "the scene");
    isResidualDefault_ = !settings.contains("residual");
    solver_.residual = settings.value("residual", solver_.residual);
    if (!(solver_.residual >= 0)) throw InputError("the residual is below 0");
    if (settings.contains("shots")) solver_.shots = settings["shots"].get<int>();
    if (solver_.shots.value_or(0) < 0) throw InputError("the number of shots is below 0");
    solver_.rowCacheBytes = std::size_t{128} << 20;
    const bool isEditable = settings.value("editable", false);
    if (isEditable && !elements.settings.isUnburied) throw InputError("the elements are not editable");
    const double start = emscripten_get_now();
    solve(isEditable);
    milliseconds_ = emscripten_get_now() - start;
  }

  Value info() const {
    const radiosity::Solution& now = solution();
    return toValue({{"shots", now.shots},
                    {"residual", now.residual},
                    {"ambient", web::toJson(now.ambient)},
                    {"energy",
                     {{"emitted", now.energy.emitted},
                      {"absorbed", now.energy.absorbed},
                      {"unshot", now.energy.unshot},
                      {"lost", now.energy.lost}}},
                    {"milliseconds", milliseconds_}});
  }

  Value radiosity() const {
    std::vector<double> numbers;
    for (const glm::dvec3& value : solution().radiosity) numbers.insert(numbers.end(), {value.r, value.g, value.b});
    return toArray("Float64Array", numbers);
  }

  Value unshot() const {
    return guarded([&] {
      const radiosity::ShootingState state = shootingState();
      std::vector<double> flux;
      for (std::uint32_t p = 0; p < state.patches().list.size(); ++p)
        flux.push_back(radiosity::bandSum(state.unshot(p)));
      return toArray("Float64Array", flux);
    });
  }

  Value brightest() const {
    return guarded([&] {
      const std::uint32_t number = shootingState().brightestPatch();
      Json elements = Json::array();
      const std::vector<std::uint32_t>& patchOf = discretization().patches.ofElement;
      for (std::size_t e = 0; e < patchOf.size(); ++e)
        if (patchOf[e] == number) elements.push_back(e);
      return toValue(elements);
    });
  }

  std::shared_ptr<ElementsHandle> elements() const {
    return std::make_shared<ElementsHandle>(
        ElementsHandle{std::make_shared<const radiosity::Scene>(scene()), elements_.settings,
                       std::make_shared<const radiosity::Discretization>(discretization())});
  }

  Value shoot(int count) { return update({}, count); }
  Value edit(const Value& edits, int shots) {
    return guarded([&] { return update(editsOf(jsonOf(edits)), shots); });
  }

  std::string csv() const {
    return guarded([&] {
      std::ostringstream stream;
      radiosity::writeCsv(stream, radiosity::elementTable(scene(), discretization(), solution()));
      return stream.str();
    });
  }

 private:
  const radiosity::Scene& scene() const { return dynamic_ ? dynamic_->scene() : *elements_.scene; }
  const radiosity::Discretization& discretization() const {
    return dynamic_ ? dynamic_->discretization() : *elements_.discretization;
  }
  const radiosity::Solution& solution() const { return dynamic_ ? dynamic_->solution() : solution_; }

  void solve(bool isEditable) {
    const radiosity::LightHooks hooks{
        .layOut = [ids = ids_](const radiosity::Discretization& edited) { return radiosity::layOut(edited, ids); }};
    radiosity::Light light = radiosity::light(*elements_.scene, *elements_.discretization,
                                              {.drawing = drawing_,
                                               .solver = solver_,
                                               .isResidualDefault = isResidualDefault_,
                                               .elements = elements_.settings,
                                               .isContinued = isEditable},
                                              hooks);
    if (isEditable) {
      light.settings.solver.shots.reset();
      dynamic_ =
          std::make_unique<radiosity::DynamicSolution>(radiosity::editable(*elements_.scene, std::move(light), hooks));
    } else {
      solution_ = std::move(light.solution);
      elements_.discretization = std::make_shared<const radiosity::Discretization>(std::move(light.discretization));
    }
  }

  Value update(const std::vector<radiosity::Edit>& edits, int shots) {
    return guarded([&] {
      if (!dynamic_) throw InputError("the solution is not editable");
      const double start = emscripten_get_now();
      dynamic_->update(edits, atMost(shots));
      milliseconds_ = emscripten_get_now() - start;
      return info();
    });
  }

  radiosity::ShootingState shootingState() const {
    if (!dynamic_) throw InputError("the solution is not editable");
    return {scene(), discretization(), discretization().patches, dynamic_->light()};
  }

  ElementsHandle elements_;
  radiosity::DrawingSettings drawing_;
  radiosity::IdSettings ids_;
  radiosity::SolverSettings solver_;
  bool isResidualDefault_ = false;
  radiosity::Solution solution_;                         ///< of one that is not editable
  std::unique_ptr<radiosity::DynamicSolution> dynamic_;  ///< of one that is
  double milliseconds_ = 0;
};

}  // namespace

Value solve(const ElementsHandle& elements, const Value& settings) {
  return guarded([&] { return Value(std::make_shared<SolutionHandle>(elements, jsonOf(settings))); });
}

EMSCRIPTEN_BINDINGS(light) {
  using namespace emscripten;
  class_<SolutionHandle>("Solution")
      .smart_ptr<std::shared_ptr<SolutionHandle>>("Solution")
      .function("info", &SolutionHandle::info)
      .function("radiosity", &SolutionHandle::radiosity)
      .function("unshot", &SolutionHandle::unshot)
      .function("brightest", &SolutionHandle::brightest)
      .function("elements", &SolutionHandle::elements)
      .function("shoot", &SolutionHandle::shoot)
      .function("edit", &SolutionHandle::edit)
      .function("csv", &SolutionHandle::csv);
}

}  // namespace hemitex::web
