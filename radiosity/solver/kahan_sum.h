/// Sums of flux, per band.
#pragma once

#include <glm/glm.hpp>

namespace hemitex::radiosity {

inline double bandSum(const glm::dvec3& flux) { return flux.x + flux.y + flux.z; }

/// A sum of fluxes to the last digit however many there are (Kahan 1965): `rest_` holds what rounding cut off so far.
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
