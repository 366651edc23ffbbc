/// Options for scenes that continue behind mirror planes or in periodic boxes.
#pragma once

#include <nlohmann/json.hpp>

#include "cli/common/options.h"
#include "radiosity/scene/symmetry.h"

namespace hemitex::cli {

void addSymmetryOptions(Command command, radiosity::Symmetry& symmetry);
nlohmann::ordered_json toJson(const radiosity::Symmetry& symmetry);

}  // namespace hemitex::cli
