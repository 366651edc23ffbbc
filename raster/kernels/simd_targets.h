/// The instruction sets that kernels were compiled for and that this processor has. For files that Highway compiles
/// once per instruction set.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace hemitex::raster {

/// Calls `action` once per instruction set, fastest first, while Highway dispatches to it. Highway has one dispatch
/// setting per program, hence the lock; it is reset afterwards.
inline void forEveryInstructionSet(const std::function<void()>& action) {
  static std::mutex choice;
  const std::lock_guard lock(choice);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    action();
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// The results of `chosen` for each instruction set, fastest first.
template <typename Kernels, typename Chosen>
std::vector<Kernels> ofEveryInstructionSet(const Chosen& chosen) {
  std::vector<Kernels> all;
  forEveryInstructionSet([&] { all.push_back(chosen()); });
  return all;
}

}  // namespace hemitex::raster
