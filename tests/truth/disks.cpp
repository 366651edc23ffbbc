#include "tests/truth/disks.h"

#include <cassert>
#include <cmath>

namespace hemitex::tests {
namespace {

/// W of the formulas in disks.h.
double rimDistances(double radius, double gap, double offset) {
  return std::hypot(gap, offset - radius) * std::hypot(gap, offset + radius);
}

}  // namespace

double coaxialDisks(double from, double to, double gap) {
  assert(from > 0 && to > 0 && gap > 0);
  return 2 * to * to / (from * from + to * to + gap * gap + rimDistances(to, gap, from));
}

double elementToParallelDisk(double radius, double gap, double offset) {
  assert(radius > 0 && gap > 0 && offset >= 0);
  const double w = rimDistances(radius, gap, offset);
  const double k = gap * gap + (offset - radius) * (offset + radius);
  if (k <= 0) return (1 - k / w) / 2;
  return 2 * (radius * gap / w) * (radius * gap / (w + k));
}

double elementToPerpendicularDisk(double radius, double gap, double offset) {
  assert(radius > 0 && gap > 0 && offset >= radius);
  const double w = rimDistances(radius, gap, offset);
  const double k = gap * gap + offset * offset + radius * radius;
  return 2 * (offset * gap / w) * (radius * radius / (w + k));
}

}  // namespace hemitex::tests
