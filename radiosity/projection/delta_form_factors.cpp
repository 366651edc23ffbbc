#include "radiosity/projection/delta_form_factors.h"

namespace hemitex::radiosity {
namespace {

GaussRule makeGaussRule() {
  const double root = std::sqrt(6.0 / 5.0);
  const double inner = std::sqrt((3 - 2 * root) / 7), outer = std::sqrt((3 + 2 * root) / 7);
  const double innerWeight = (18 + std::sqrt(30.0)) / 72, outerWeight = (18 - std::sqrt(30.0)) / 72;
  return {{(1 - outer) / 2, (1 - inner) / 2, (1 + inner) / 2, (1 + outer) / 2},
          {outerWeight, innerWeight, innerWeight, outerWeight}};
}

}  // namespace

const GaussRule& gaussRule() {
  static const GaussRule rule = makeGaussRule();
  return rule;
}

std::uint64_t toShare(double formFactor) {
  return static_cast<std::uint64_t>(std::nearbyint(std::ldexp(formFactor, shareBits)));
}

std::vector<std::uint64_t> mirroredQuadrant(const std::vector<std::uint64_t>& quadrant, int half) {
  const auto fromMiddle = [half](int i) { return static_cast<std::size_t>(i < half ? half - 1 - i : i - half); };
  std::vector<std::uint64_t> table;
  table.reserve(4 * quadrant.size());
  for (int row = 0; row < 2 * half; ++row)
    for (int column = 0; column < 2 * half; ++column)
      table.push_back(quadrant[fromMiddle(row) * static_cast<std::size_t>(half) + fromMiddle(column)]);
  return table;
}

void spread(std::vector<std::uint64_t>& shares, std::int64_t missing) {
  const auto count = static_cast<std::int64_t>(shares.size());
  const std::int64_t remainder = (missing % count + count) % count;
  const std::int64_t each = (missing - remainder) / count;
  for (std::int64_t i = 0; i < count; ++i)
    shares[static_cast<std::size_t>(i)] += static_cast<std::uint64_t>(each + (i < remainder ? 1 : 0));
}

}  // namespace hemitex::radiosity
