#include "radiosity/projections.h"

#include "radiosity/cubic_tetrahedron.h"
#include "radiosity/hemicube.h"
#include "radiosity/single_plane.h"

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
