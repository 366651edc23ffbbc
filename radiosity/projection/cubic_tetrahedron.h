/// The cubic tetrahedron (Beran-Koehn and Pavicic 1991): a corner of a cube that stands over a point so that the cube's
/// diagonal is the normal. Its three faces see the whole half space; a hemicube needs five.
///
/// Coordinates of a face are those at distance 1. The corner is at (1, 1); the common edges with the other faces are x
/// = 1 and y = 1; the horizon is x + y = -1. The part above the horizon is a right isosceles triangle from the corner
/// to (1, -2) and (-2, 1). Pixels count from the corner. Their width, 6 / (2R + 1), puts the horizon halfway between
/// two diagonals of samples. So no sample lies on the horizon or on a common edge. Samples below the horizon have no
/// weight.
///
/// A pixel that the horizon cuts has the weight of the part above it. Some pixels have corners above the horizon but
/// their sample below it. Those corners count for the two adjacent pixels, half for each, so that the sum of all shares
/// is exact.
///
/// Rows of the Cornell box: sum of all errors (see reference::distanceToTruth), for equal numbers of pixels above the
/// horizon:
///
///     hemicube       R = 32: 0.20   64: 0.079   128: 0.031   256: 0.0117   512: 0.0045
///     tetrahedron    R = 44: 0.22   90: 0.077   180: 0.026   362: 0.0091   724: 0.0032
///
/// Its pixels are more uniform, but half of the pixels drawn are below the horizon.
#pragma once

#include <vector>

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

/// Three faces of resolution x resolution pixels, each rotated by a third of a turn. The first leans towards the
/// projection's up direction. The frustum is off-axis, so that the rows x, y, w are not orthogonal; all determinants
/// are equal and above 0. `resolution` is even, 2 to 4096.
std::vector<ProjectionFace> cubicTetrahedronFaces(int resolution);

/// These faces with their delta form factors, rounded so that they sum to exactly 2^60. Three does not divide 2^60: the
/// pixel at the first face's corner has one unit more than those of the others.
Projection cubicTetrahedron(int resolution);

}  // namespace hemitex::radiosity
