/// The derivation of a pixel as text for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "raster/interface/face.h"

namespace hemitex::reference {

/// Lines for an explanation (explanation.h) of a pixel of `face`: its item ID and, if a triangle covers it, the view
/// and each step of the derivation with the formula of its values.
std::string derivationText(const nlohmann::ordered_json& explanation, const raster::Face& face);

}  // namespace hemitex::reference
