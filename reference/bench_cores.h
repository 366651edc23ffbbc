/// What the second core brings: to pure arithmetic, which needs nothing else of the machine, and beside it to a
/// hemicube and to a whole solution. All in turns.
#pragma once

#include "reference/bench_scenes.h"

namespace hemitex::reference {

/// How many times faster each is on two threads than on one.
struct CoreGains {
  double arithmetic = 0, hemicube = 0, solution = 0;
};

/// `resolution` is that of both; the solution has `shots`. More than one thread must be allowed.
CoreGains coreGains(const BenchScene& scene, int resolution, int shots, int repeats);

}  // namespace hemitex::reference
