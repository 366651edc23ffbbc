/// The scenes of the tables of Nielsen and Christensen (2002), with the discretizations of the paper.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/measurement/paper/runs.h"

namespace hemitex::reference {

/// Loads the scenes from the folder of the program's scenes:
/// - "simple" (Figure 2): a closed room with a box and a light. Walls have 6 x 6, 12 x 12 and 24 x 24 elements, faces
/// of
///   the box 2 x 2, 4 x 4 and 8 x 8, and the light one: together 241, 961 and 3841. Patches have 2 x 2, 4 x 4 and 8 x 8
///   elements, 61 patches at each level. 100 shots (Table 1).
/// - "complex" (Figure 4): the gallery of 8088 triangles. Its elements are packed into eight pages of 64 x 64, 128 x
///   128 and 256 x 256 texels, with patches of 4 x 4, 8 x 8 and 16 x 16. The paper does not give the number of shots;
///   it is 100 here.
/// - "plant": a room with plants of 1000 leaves and elements of a quarter of a metre. Meshing adds no polygons to
/// leaves.
/// - "fill-limited": the simple scene with 2 x 2 elements per wall and one per face of the box. Meshing adds few
/// polygons.
std::vector<PaperScene> paperScenes(const std::filesystem::path& folder);

}  // namespace hemitex::reference
