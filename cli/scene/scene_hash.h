/// A hash of scenes, by which files of unfinished runs recognize theirs.
#pragma once

#include <string>

#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The SHA-256 of all that a solution or form factors depend on in a scene, as 64 hexadecimal digits.
std::string hashOf(const radiosity::Scene& scene);

}  // namespace hemitex::cli
