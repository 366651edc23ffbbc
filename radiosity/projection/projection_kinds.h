/// The kinds of projections, and their delta form factors: integrals over the solid angle of each pixel.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/projection/projection.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

enum class ProjectionKind { Hemicube, SinglePlane, CubicTetrahedron };

/// The names of projections, as options and settings call them; the default is first.
std::vector<std::pair<std::string, ProjectionKind>> namedProjections();

/// The projection of a kind with faces of resolution x resolution pixels; `resolution` is even, 2 to 4096, here and
/// below.
Projection projectionOf(ProjectionKind kind, int resolution);

/// The hemicube (Cohen and Greenberg 1985): half a cube over a point. It sees the whole half space. Its pixels have the
/// smallest solid angles near the edges between faces, where the picture plane is farthest away. Delta form factors are
/// rounded so that they sum to exactly 2^60.
Projection hemicube(int resolution);

/// The top, then the sides that look along the top's +x, +y, -x and -y; their rows grow away from the horizon. All
/// determinants are 1. The top has resolution x resolution pixels, a side the upper half of that.
std::vector<ProjectionFace> hemicubeFaces(int resolution);

/// Squared reach of a hemicube, given by its corners (see Projection::squaredReach).
inline constexpr double hemicubeSquaredReach = 3;

/// Near the optimum for all three resolutions of docs/light.md, and a power of two, so that the rows x, y, w are exact.
inline constexpr double planeHalfWidth = 4;

/// The single plane (Recker, George and Greenberg 1990): one square face over a point, wide enough for most of the
/// light. It needs one view instead of five. Light below its edges is lost.
///
/// A square of half-width t at distance 1, centred over the point, has the form factor of four rectangles with a corner
/// on the normal. With c = t / sqrt(1 + t^2), the share is 4/pi c atan(c):
///
///     t         1      2      3      4      6      8      12     16
///     captured  0.554  0.831  0.917  0.951  0.978  0.987  0.994  0.997
///
/// docs/light.md has the errors of rows by width: the plane is the fastest and the least accurate projection.
///
/// A plane of resolution x resolution pixels at a distance of 1, from -halfWidth to halfWidth along the axes of the
/// projection. Shares are the integrals over the solid angle of each pixel, and `captured` is their sum.
/// `halfWidth` is above 0 and at most 64.
Projection singlePlane(int resolution, double halfWidth = planeHalfWidth);

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
/// Its pixels are more uniform, but half of the pixels drawn are below the horizon; docs/light.md compares both.
///
/// Delta form factors are rounded so that they sum to exactly 2^60. Three does not divide 2^60: the pixel at the first
/// face's corner has one unit more than those of the others.
Projection cubicTetrahedron(int resolution);

/// Three faces of resolution x resolution pixels, each rotated by a third of a turn. The first leans towards the
/// projection's up direction. The frustum is off-axis, so that the rows x, y, w are not orthogonal; all determinants
/// are equal and above 0.
std::vector<ProjectionFace> cubicTetrahedronFaces(int resolution);

/// The intensity of a spot over its full one, where a direction makes an angle with this cosine to the axis.
double intensityAt(const LampCone& cone, double cosine);

/// The solid angle that would have all flux of a lamp at its full intensity, 4 pi without a cone.
double fullSolidAngle(const std::optional<LampCone>& cone);

/// Wider faces of a lamp become a cube, which sees more with the same pixels.
inline constexpr double widestLampFace = 2;

/// The projection of a lamp that is a point. Its shares are those of the flux of the lamp: the integral of the
/// intensity over the solid angle of each pixel, over that of all directions. The axis of the cone is in the axes of
/// the projection. Up to widestLampFace there is one face along +z, `halfWidth` wide to each side at a distance of 1;
/// else six, a hemicube with its mirror image. `holdsAll`: no light passes beside the face, so that the shares sum to 1
/// less 2^-40, which rounding needs.
Projection lampProjection(int resolution, const std::optional<LampCone>& cone,
                          double halfWidth = std::numeric_limits<double>::infinity(), bool holdsAll = true);

}  // namespace hemitex::radiosity
