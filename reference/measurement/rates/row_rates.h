/// Measures how many rows of form factors a second gives: by threads of the processor, and by devices, whose pixels are
/// read back or summed where they are drawn. Over levels of discretization it shows what elements cost.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reference/measurement/paper/runs.h"

namespace hemitex::reference {

struct RowRate {
  std::string scene, level;
  std::size_t triangles = 0, elements = 0;
  int resolution = 0;
  std::string what;  ///< `software, N threads`, or a device, `read back` or `summed`
  double rowsPerSecond = 0;
};

struct RowRateSettings {
  std::vector<int> resolutions = {128, 256, 1024};
  int threads = 1;  ///< all threads; rows are also measured with one
  int repeats = 3;
};

/// The rates of each scene, level and resolution: the medians of interleaved repetitions, each of the same patches, as
/// many as have 32 rows of 1024 pixels or 256 of 128.
std::vector<RowRate> rowRates(const std::vector<PaperScene>& scenes, const std::vector<PaperDevice>& devices,
                              const RowRateSettings& settings,
                              const std::function<void(const std::string& what)>& progress);

}  // namespace hemitex::reference
