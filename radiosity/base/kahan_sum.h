/// Sums of flux per band.
#pragma once

#include <glm/glm.hpp>

namespace hemitex::radiosity {

/// A compensated sum (Kahan 1965), accurate to the last digit for any number of terms; `rest_` holds the rounding error
/// so far.
class KahanSum {
 public:
  void add(const glm::dvec3& flux) {
    const glm::dvec3 term = flux - rest_;
    const glm::dvec3 sum = sum_ + term;
    rest_ = (sum - sum_) - term;
    sum_ = sum;
  }
  const glm::dvec3& value() const { return sum_; }

 private:
  glm::dvec3 sum_{0.0}, rest_{0.0};
};

}  // namespace hemitex::radiosity
