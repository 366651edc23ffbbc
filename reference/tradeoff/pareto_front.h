/// The Pareto front: of many choices with a cost and an error, those that no other one beats.
#pragma once

#include <span>
#include <vector>

namespace hemitex::reference {

/// Whether each choice is on the front: no other one costs as much or less and errs as much or less, one of them less.
/// Equal choices are on it together. All numbers are finite.
std::vector<bool> paretoFront(std::span<const double> cost, std::span<const double> error);

}  // namespace hemitex::reference
