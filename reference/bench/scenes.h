/// The scenes that speed is measured on, and how they are discretized.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

struct BenchScene {
  std::string name;  ///< of the file, without its ending
  radiosity::Scene scene;
  radiosity::DiscretizationSettings elements;
  radiosity::IdSettings ids;
};

/// The elements of the paper's room: `wall` along the side of a wall, `boxFace` along that of a face of the box,
/// `patch` along that of a patch; the light is one element.
radiosity::DiscretizationSettings roomElements(int wall, int boxFace, int patch);

/// The elements and IDs of a scene in eight packed pages of 64 x 64 texels, each split into subdivision x subdivision;
/// patches have 4 x 4 of the texels that are not split.
BenchScene packedScene(std::string name, radiosity::Scene scene, int subdivision);

/// By the program's defaults. Throws InputError where nothing emits.
BenchScene benchScene(const std::filesystem::path& file);

/// The paper's room, the Cornell box and the gallery, which stands for the paper's complex scene, from the folder of
/// the scenes that come with the program; the room and the gallery as finely as the paper's fine level.
std::vector<BenchScene> benchScenes(const std::filesystem::path& folder);

/// Form factors from the patches as they are discretized: none is split. The scene must outlive the result.
radiosity::SceneFormFactors unsplitFormFactors(
    const radiosity::Scene& scene, const radiosity::DiscretizationSettings& elements, const radiosity::IdSettings& ids,
    int resolution, const radiosity::RendererFactory& renderer = radiosity::softwareRenderer);

}  // namespace hemitex::reference
