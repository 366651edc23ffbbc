// The Pareto front against its definition for pairs of choices.
#include "reference/measurement/tradeoff/pareto_front.h"

#include <catch2/catch.hpp>
#include <random>

using namespace hemitex;

namespace {

std::vector<bool> byDefinition(const std::vector<double>& cost, const std::vector<double>& error) {
  std::vector<bool> isOnFront;
  for (std::size_t i = 0; i < cost.size(); ++i) {
    bool isBeaten = false;
    for (std::size_t j = 0; j < cost.size(); ++j)
      isBeaten |= cost[j] <= cost[i] && error[j] <= error[i] && (cost[j] < cost[i] || error[j] < error[i]);
    isOnFront.push_back(!isBeaten);
  }
  return isOnFront;
}

}  // namespace

TEST_CASE("paretoFront agrees with its definition, also for ties and equal choices", "[tradeoff]") {
  std::mt19937 random(1);
  for (const unsigned values : {2U, 5U, 1000U})
    for (std::size_t size = 0; size < 40; ++size) {
      std::vector<double> cost, error;
      for (std::size_t i = 0; i < size; ++i) {
        cost.push_back(static_cast<double>(random() % values));
        error.push_back(static_cast<double>(random() % values));
      }
      CHECK(reference::paretoFront(cost, error) == byDefinition(cost, error));
    }
}
