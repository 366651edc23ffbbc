/// The cubic tetrahedron (Beran-Koehn and Pavicic 1991): a cube's corner that stands over a point so that its diagonal
/// is the normal. Its three faces see the whole half space, where a hemicube takes five.
///
/// In the coordinates of a face at distance 1, the corner is at (1, 1), the two seams are x = 1 and y = 1, and the
/// horizon is the line x + y = -1: what lies above it is a right isosceles triangle from the corner to (1, -2) and
/// (-2, 1). Pixels are counted from the corner and are so wide, 6 / (2R + 1), that this line runs halfway between two
/// diagonals of samples; no sample lies on the horizon or on a seam. Samples below it see nothing that counts.
///
/// A pixel that the horizon cuts stands for the part above it. The corners of pixels that reach above the horizon while
/// their sample lies below it belong to the two pixels beside them, half to each, so that all shares sum to the whole.
///
/// Of rows of the Cornell box, the sum of all errors (see reference::distanceToTruth) by as many pixels that count:
///
///     hemicube       R = 32: 0.20   64: 0.079   128: 0.031   256: 0.0117   512: 0.0045
///     tetrahedron    R = 44: 0.22   90: 0.077   180: 0.026   362: 0.0091   724: 0.0032
///
/// Its pixels lie more evenly, but twice as many are drawn as count.
#pragma once

#include <vector>

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

/// Three faces of resolution x resolution pixels, alike but for a third of a turn; the first leans towards the
/// projection's up. The projection is one of a cube's corner off the middle of the view, so rows are not orthogonal;
/// all determinants are alike and above 0. `resolution` is even, 2 to 4096.
std::vector<ProjectionFace> cubicTetrahedronFaces(int resolution);

/// These faces with their delta form factors, rounded so that they sum to exactly 2^60, which three does not divide:
/// the pixel at the first face's corner has one unit more than those of the others.
Projection cubicTetrahedron(int resolution);

}  // namespace hemitex::radiosity
