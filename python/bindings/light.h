/// Light for Python: solutions, edits of solved scenes, and sensitivities.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "python/bindings/calls.h"
#include "python/bindings/scenes.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/camera.h"
#include "reference/rows/solution_rows.h"

namespace hemitex::python {

using SharedSolution = std::shared_ptr<const radiosity::Solution>;

/// What a solution is computed with.
struct Method {
  radiosity::LightSettings light;
  radiosity::IdSettings ids;
  radiosity::OtherRows rows;                                              ///< empty: they are drawn
  reference::RowErrors errors = std::make_shared<std::vector<double>>();  ///< of rows with a bound
  radiosity::RendererFactory makeRenderer;
};

/// A solution; the elements have the patches as split.
struct Solved {
  Method method;
  SharedElements elements;
  SharedSolution solution;  ///< without patches and continuation
  std::optional<radiosity::LightErrors> expectedErrors;
  std::unique_ptr<radiosity::DynamicSolution> dynamic;  ///< of one that can be edited; an edit moves it on
  bool isEdited = false;
  std::mutex mutex;  ///< held by an edit
};

/// The camera of a dictionary: `eye`, `look_at`, `up`, `fov`.
radiosity::Camera cameraOf(const py::dict& dictionary);

void addLight(py::module_& module);

}  // namespace hemitex::python
