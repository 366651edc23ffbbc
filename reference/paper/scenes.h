/// The scenes of the paper's tables, discretized as it says.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/paper/runs.h"

namespace hemitex::reference {

/// From the folder of the scenes that come with the program:
/// - "simple" (Figure 2), a closed room with a box and a light. Walls of 6 x 6, 12 x 12 and 24 x 24 elements, faces of
///   the box of 2 x 2, 4 x 4 and 8 x 8, the light one: 241, 961 and 3841. Patches of 2 x 2, 4 x 4 and 8 x 8, 61 at each
///   level, and 100 shots (Table 1);
/// - "complex" (Figure 4), the gallery of 8088 triangles. Its elements are packed into eight pages of 64 x 64, 128 x
///   128 and 256 x 256 texels, with patches of 4 x 4, 8 x 8 and 16 x 16. The paper does not say how many shots it took;
/// - "plant", a room with plants of 1000 leaves, elements of a quarter of a metre: there is nothing to mesh in them;
/// - "fill-limited", the simple scene with 2 x 2 elements a wall and undivided faces: there is next to nothing to mesh.
std::vector<PaperScene> paperScenes(const std::filesystem::path& folder);

}  // namespace hemitex::reference
