/// Boxes, the parts of furniture, complete or without the faces on which they stand or hang.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// An axis-parallel box; `low` is below `high` in each coordinate.
struct Box {
  glm::dvec3 low{0.0}, high{0.0};
};

/// The faces of a box: front is +z, right +x, top +y.
enum class Side { Front, Right, Back, Left, Top, Bottom };

/// One face, facing outwards.
Polygon face(const Box& box, Side side);

/// The faces in the order of Side, without those in `without`, facing outwards.
std::vector<Polygon> faces(const Box& box, const std::vector<Side>& without = {});

/// Gives four to six quads one common chart, each in a cell of its own. The first four are columns of a quarter of the
/// width, in the lower half of the chart if there are more; the others share the upper half. If the number of columns
/// and of rows are multiples of 4, no texel lies in two cells.
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
