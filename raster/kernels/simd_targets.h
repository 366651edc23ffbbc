/// The instruction sets that kernels were compiled for and this processor has: for files that Highway compiles anew for
/// each of them.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace hemitex::raster {

/// Calls `action` while Highway chooses each of them, the best first. It has one choice for the whole program, which is
/// free again afterwards.
inline void forEveryInstructionSet(const std::function<void()>& action) {
  static std::mutex choice;
  const std::lock_guard lock(choice);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    action();
  }
  hwy::SetSupportedTargetsForTest(0);
}

/// What `chosen` gives with each of them, the best first.
template <typename Kernels, typename Chosen>
std::vector<Kernels> ofEveryInstructionSet(const Chosen& chosen) {
  std::vector<Kernels> all;
  forEveryInstructionSet([&] { all.push_back(chosen()); });
  return all;
}

}  // namespace hemitex::raster
