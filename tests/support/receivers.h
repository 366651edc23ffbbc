/// Receivers of form factors by rays.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/truth/rays/monte_carlo_form_factors.h"

namespace hemitex::tests {

/// One element is the receiver; light that reaches others counts as background.
inline reference::Receivers onlyElement(const radiosity::Discretization& discretization, std::uint32_t element) {
  reference::Receivers receivers{
      1, std::vector<std::uint32_t>(discretization.elements.size(), reference::Receivers::none)};
  receivers.ofElement[element] = 0;
  return receivers;
}

}  // namespace hemitex::tests
