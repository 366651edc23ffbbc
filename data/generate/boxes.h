/// Boxes: what furniture is built of, whole or without the faces on which they stand or hang.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// A box with sides along the axes; `low` is below `high` in every coordinate.
struct Box {
  glm::dvec3 low{0.0}, high{0.0};
};

/// The faces of a box: front is +z, right +x, top +y.
enum class Side { Front, Right, Back, Left, Top, Bottom };

/// One face; it faces outwards.
Polygon face(const Box& box, Side side);

/// The faces in the order of Side, without those named; they face outwards.
std::vector<Polygon> faces(const Box& box, const std::vector<Side>& without = {});

/// Gives four to six quads one chart that they fill, each a cell of its own: the first four are columns of a quarter
/// width, in the lower half of the chart where there are more; those share the upper half. Grids whose columns and rows
/// are multiples of 4 have no texel in two cells.
std::vector<Polygon> charted(std::vector<Polygon> quads);

/// A box as one group with one chart.
Group boxGroup(const std::string& name, const std::string& material, const Box& box,
               const std::vector<Side>& without = {});

/// A face as a group, `name-front`, `name-right` and so on.
Group faceGroup(const std::string& name, const std::string& material, const Box& box, Side side);

/// One group per face.
std::vector<Group> faceGroups(const std::string& name, const std::string& material, const Box& box,
                              const std::vector<Side>& without = {});

}  // namespace hemitex::data
