#include "raster/kernels/kernels.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "raster/kernels/interpolation_bounds.h"
#include "raster/kernels/unresolved_samples.h"

// Highway compiles the rest of this file once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/kernels/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// clang-format off
#include "raster/kernels/vectors-inl.h"
#include "raster/kernels/vertices-inl.h"
#include "raster/kernels/small_triangles-inl.h"
#include "raster/kernels/depths-inl.h"
#include "raster/kernels/texels-inl.h"
#include "raster/kernels/runs-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE {
namespace {

Kernels kernels() {
  return {hwy::TargetName(HWY_TARGET), vertices::place,         small::setUp,     small::draw,
          depths::testDepths,          depths::isHidden,        depths::endOfRun, depths::endOfSmall,
          texels::findTexels,          texels::findExactTexels, runs::findChanges};
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hemitex::raster {
namespace {

HWY_EXPORT(kernels);

std::vector<Kernels> compiledKernels() {
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0  // a build for one instruction set, which needs no library of Highway
  return {HWY_STATIC_DISPATCH(kernels)()};
#else
  std::vector<Kernels> all;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::ChosenTarget chosen;  // one of our own, because Highway's belongs to the whole process
    chosen.Update(target);
    all.push_back(HWY_DISPATCH_TABLE(kernels)[chosen.GetIndex()]());
  }
  return all;
#endif
}

}  // namespace

const std::vector<Kernels>& allKernels() {
  static const std::vector<Kernels> all = compiledKernels();
  return all;
}

}  // namespace hemitex::raster
#endif
