#include "cli/bench_json.h"

namespace hemitex::cli {

using nlohmann::ordered_json;

ordered_json toJson(const std::vector<reference::BenchRun>& runs) {
  constexpr double milliseconds = 1000;
  ordered_json list = ordered_json::array();
  for (const reference::BenchRun& run : runs)
    list.push_back({{"scene", run.scene},
                    {"triangles", run.triangles},
                    {"elements", run.elements},
                    {"resolution", run.resolution},
                    {"threads", run.threads},
                    {"what", run.what},
                    {"median_ms", run.seconds.median * milliseconds},
                    {"min_ms", run.seconds.least * milliseconds},
                    {"repeats", run.seconds.repeats}});
  return list;
}

}  // namespace hemitex::cli
