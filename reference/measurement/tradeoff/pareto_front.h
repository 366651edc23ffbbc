/// Computes the Pareto front of choices with a cost and an error.
#pragma once

#include <span>
#include <vector>

namespace hemitex::reference {

/// For each choice, whether it is on the front. A choice is not on the front if another one has at most the same cost
/// and error, and a smaller cost or error. Equal choices have equal results. All numbers must be finite.
std::vector<bool> paretoFront(std::span<const double> cost, std::span<const double> error);

}  // namespace hemitex::reference
