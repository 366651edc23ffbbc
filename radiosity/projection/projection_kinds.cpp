#include "radiosity/projection/projection_kinds.h"

#include "radiosity/projection/cubic_tetrahedron.h"
#include "radiosity/projection/hemicube.h"
#include "radiosity/projection/single_plane.h"

namespace hemitex::radiosity {

Projection projectionOf(ProjectionKind kind, int resolution) {
  switch (kind) {
    case ProjectionKind::SinglePlane:
      return singlePlane(resolution);
    case ProjectionKind::CubicTetrahedron:
      return cubicTetrahedron(resolution);
    default:
      return hemicube(resolution);
  }
}

}  // namespace hemitex::radiosity
