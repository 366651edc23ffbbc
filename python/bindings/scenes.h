/// Scenes and their elements as Python sees them.
#pragma once

#include <memory>

#include "python/bindings/calls.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_edits.h"
#include "radiosity/scene/surface_names.h"

namespace hemitex::python {

using SharedScene = std::shared_ptr<const radiosity::Scene>;

/// A scene, and the surfaces that edits removed from it.
struct PythonScene {
  SharedScene scene;
  bool facets = false;  ///< whether each face of the file is a surface
  std::vector<radiosity::Surface> removed = {};
  std::shared_ptr<const radiosity::PolygonMesh> mesh = {};  ///< of facets that are no file's
};

/// A scene that is divided into elements and patches.
struct Elements {
  SharedScene scene;
  bool facets = false;
  radiosity::DiscretizationSettings settings;
  radiosity::Discretization discretization;
};
using SharedElements = std::shared_ptr<const Elements>;

/// The rows and columns of matrices: facets, or families of surfaces.
radiosity::Families familiesOf(const Elements& elements);

/// Edits from a list of (kind, name, argument): `move`, `remove`, `restore`, `add`, `emission`, `reflectance`.
std::vector<radiosity::Edit> editsOf(const py::sequence& list);

void addScenes(py::module_& module);

}  // namespace hemitex::python
