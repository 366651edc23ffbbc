#include "reference/measurement/tradeoff/pareto_front.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace hemitex::reference {

/// In the order of ascending cost, a choice is on the front if its error is below those of all choices before it.
std::vector<bool> paretoFront(std::span<const double> cost, std::span<const double> error) {
  assert(cost.size() == error.size());
  const auto choice = [&](std::size_t i) { return std::pair{cost[i], error[i]}; };
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return choice(a) < choice(b); });
  std::vector<bool> isOnFront(cost.size());
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool equalsLast = i > 0 && choice(order[i]) == choice(order[i - 1]);
    isOnFront[order[i]] = equalsLast ? isOnFront[order[i - 1]] : error[order[i]] < smallest;
    smallest = std::min(smallest, error[order[i]]);
  }
  return isOnFront;
}

}  // namespace hemitex::reference
