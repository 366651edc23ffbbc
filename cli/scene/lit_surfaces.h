/// The surfaces of a solved scene, from the files of its folder. scene.obj holds their triangles object by object, and
/// solution.json says which are whose.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// Gives a scene that loadScene read from scene.obj the surfaces of `surfaces`, the list in solution.json: each has the
/// next `triangles` faces of the file. Each is a family of its own, and has the charts of the file: its part of a
/// texture. Returns their numbers in the list, because a surface whose faces were all left out is missing. Throws
/// std::exception if the list does not belong to the scene.
std::vector<std::uint32_t> restoreSurfaces(radiosity::Scene& lit, const nlohmann::ordered_json& surfaces);

}  // namespace hemitex::cli
