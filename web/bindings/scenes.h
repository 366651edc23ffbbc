/// Scenes and elements that JavaScript holds, and the settings of drawings and item IDs.
///
/// All handles of JavaScript are shared pointers: Emscripten releases what those point to when JavaScript has dropped
/// the handle. It does not do so for objects that it holds by value.
#pragma once

#include <memory>
#include <string>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "web/bindings/values.h"

namespace hemitex::web {

/// The elements of a scene; neither changes.
struct ElementsHandle {
  std::shared_ptr<const radiosity::Scene> scene;
  radiosity::DiscretizationSettings settings;
  std::shared_ptr<const radiosity::Discretization> discretization;
};

/// The name of a surface, the number of its triangles, and its material.
Json describe(const radiosity::Scene& scene, const radiosity::Surface& surface);

/// The settings of an object; see DrawingSettings and IdSettings in web/page/core.ts. Throw InputError for values out
/// of range and for unknown names.
radiosity::DrawingSettings drawingSettings(const Json& settings);
radiosity::IdSettings idSettings(const Json& settings);

}  // namespace hemitex::web
