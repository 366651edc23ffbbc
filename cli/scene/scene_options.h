/// Options of commands that read a scene, divide it into elements and draw it. A wrong value is a usage error that
/// names the option.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/options.h"
#include "cli/scene/material_options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"
#include "raster/interface/item_id.h"

namespace hemitex::cli {

/// The file of the scene, the settings for reading it, and changes of its materials.
struct SceneOptions {
  std::filesystem::path file;
  radiosity::SceneSettings settings;
  MaterialOptions materials;
};
void addSceneOptions(Command command, SceneOptions& options);
nlohmann::ordered_json toJson(const radiosity::SceneSettings& settings);
/// Loads the scene, changes its materials, and separates its surfaces at walls unless they are facets. Throws InputError
/// as radiosity::loadScene and withMaterials.
radiosity::Scene loadedScene(const SceneOptions& options);
/// As loadedScene, and prints the warnings of the scene.
radiosity::Scene sceneOf(const SceneOptions& options, Console& console);
/// As radiosity::requireEmission. For a scene without any light the message names the largest surfaces and the option.
/// `alternative` continues that advice.
void requireLight(const radiosity::Scene& scene, const std::filesystem::path& file,
                  const std::string& alternative = "");

/// Makes each face of a file a facet: a surface, with --two-sided two. It is one element unless the settings have a
/// size of texels.
void chooseFacets(radiosity::SceneSettings& scene, radiosity::DiscretizationSettings& elements);

/// Adds the options for dividing surfaces into elements and patches.
void addDiscretizationOptions(Command command, radiosity::DiscretizationSettings& settings);
/// Discretizes the scene. Throws InputError with similar names if the scene has no surface of a given name.
radiosity::Discretization discretizationOf(const radiosity::DiscretizationSettings& settings,
                                           const radiosity::Scene& scene);
/// The settings that were given, and null for others.
nlohmann::ordered_json toJson(const radiosity::DiscretizationSettings& settings);

/// Adds the options for assigning item IDs to elements.
void addIdOptions(Command command, radiosity::IdSettings& settings);
/// The layout of item IDs, for light and form factors. Throws InputError as radiosity::layOut, if options for offsets
/// are given with unique index maps, which have no offsets, and if sums of offsets and indices overflow.
radiosity::IdLayout layoutOf(const radiosity::IdSettings& settings, const radiosity::Discretization& discretization);
/// As layoutOf, for pictures and test vectors of item IDs: only warns of sums that overflow, which they show.
radiosity::IdLayout shownLayoutOf(const radiosity::IdSettings& settings,
                                  const radiosity::Discretization& discretization, Console& console);
nlohmann::ordered_json toJson(const radiosity::IdSettings& settings);

/// Adds `--resolution`: pixels along the side of a face, even, 2 to 4096.
Option addResolution(Command command, int& resolution);
/// Adds the repeatable option `--resolution`.
Option addResolutions(Command command, std::vector<int>& resolutions);

/// Adds the options of projections, except the choice of the projection.
void addDrawingOptions(Command command, radiosity::DrawingSettings& settings);
nlohmann::ordered_json toJson(const radiosity::DrawingSettings& settings);

/// The projection of a `--method`: `hemicube`, `single-plane` or `tetrahedron`; nothing for methods that do not draw.
std::optional<radiosity::ProjectionKind> projectionNamed(const std::string& method);
/// Adds `--method`: one of the projections, or of `others`.
Option addMethod(Command command, std::string& method, const std::vector<std::string>& others, const std::string& help);

/// The names of the options that only methods with projections use: of drawing and of item IDs.
std::vector<std::string> drawingOptionNames();
/// Throws a usage error if one of the options was given; call it for options that a method does not use.
void refuseUnused(Command command, const std::vector<std::string>& options, const std::string& method);

}  // namespace hemitex::cli
