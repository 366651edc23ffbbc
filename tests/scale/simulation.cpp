/// Simulates parallel solutions: the time and the useful share of rows for 2 to 64 ranks. Row times and the time of
/// rank 0 are measured on one thread; the clocks of the other ranks and the network are simulated. The decisions are
/// those of RowsAhead itself.
///
///     hemitex_scale [SCENE.obj [SHOTS [SPLIT]]]
///
/// With SPLIT 1 no patch is split (see PatchSubdivision).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/rows_ahead.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/ranks/shared_tasks.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// The processor time of this process, which has one thread: other load of the machine does not change it much.
double now() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A network of 10 Gbit/s.
constexpr double latency = 20e-6, bytesPerSecond = 1.25e9;

/// A task and its result start with the number of the task.
constexpr std::size_t numberBytes = sizeof(std::uint64_t);

/// A result without its number, and the seconds that it took.
struct Measured {
  std::string bytes;
  double seconds = 0;
};
/// By the bytes of the points. Each row is computed once for all simulated runs.
using MeasuredRows = std::map<std::string, Measured>;

/// Computes the rows of all ranks in this process, and delivers each when a real rank would have.
class SimulatedRanks final : public Messenger {
 public:
  SimulatedRanks(int ranks, ProjectedFormFactors& rows, MeasuredRows& measured)
      : rows_(rows), measured_(measured), free_(static_cast<std::size_t>(ranks), 0.0), start_(now()) {}

  int rank() const override { return 0; }
  int ranks() const override { return static_cast<int>(free_.size()); }
  void send(int to, MessageKind kind, std::string bytes) override {
    isWaiting_ = false;
    const double sent = clock();
    if (kind == MessageKind::Over) return add(sent, {to, MessageKind::Done, {}});
    const double before = now();
    const Measured& row = computed(bytes);
    outside_ += now() - before;
    double& free = free_[static_cast<std::size_t>(to)];
    free = std::max(free, sent + latency) + row.seconds;
    add(free + latency + static_cast<double>(row.bytes.size()) / bytesPerSecond,
        {to, MessageKind::Result, bytes.substr(0, numberBytes) + row.bytes});
  }
  std::optional<Message> receive() override {
    if (arriving_.empty()) return std::nullopt;
    if (arriving_.begin()->first > clock()) {
      // Looking twice without a message means to wait for the next one.
      if (!std::exchange(isWaiting_, true)) return std::nullopt;
      waited_ += arriving_.begin()->first - clock();
    }
    isWaiting_ = false;
    Message message = std::move(arriving_.begin()->second);
    arriving_.erase(arriving_.begin());
    return message;
  }
  [[noreturn]] void abort(int exitCode) override { std::exit(exitCode); }

  /// The simulated seconds since the start.
  double clock() const { return now() - start_ - outside_ + waited_; }
  double waited() const { return waited_; }

 private:
  void add(double time, Message message) { arriving_.emplace(time, std::move(message)); }
  const Measured& computed(const std::string& task) {
    const auto [found, isNew] = measured_.try_emplace(task.substr(numberBytes));
    if (isNew) {
      const double before = now();
      const std::string result = resultOf(task, rows_);
      found->second = {result.substr(numberBytes), now() - before};
    }
    return found->second;
  }

  ProjectedFormFactors& rows_;
  MeasuredRows& measured_;
  std::multimap<double, Message> arriving_;
  std::vector<double> free_;  ///< when each rank has no more tasks
  double start_, outside_ = 0, waited_ = 0;
  bool isWaiting_ = false;
};

struct Run {
  double seconds = 0, waited = 0;
  RowCounts counts;
};

Run simulated(int ranks, const Scene& scene, const Discretization& discretization, int resolution, double split,
              const SolverSettings& settings, MeasuredRows& measured) {
  SceneFormFactors formFactors(scene, discretization, layOut(discretization),
                               {.resolution = resolution, .split = split});
  SceneFormFactors ofOthers(scene, discretization, layOut(discretization), {.resolution = resolution, .split = split});
  SimulatedRanks messenger(ranks, ofOthers.uncorrected(), measured);
  RowsAhead rows(&messenger, formFactors, settings.rowCacheBytes);
  solve({.scene = scene,
         .discretization = discretization,
         .patches = discretization.patches,
         .rowOf = [&](const Patch& patch) { return rows.row(patch); },
         .split = formFactors.splits(),
         .prepare = [&](const NextShots& next) { rows.lookAhead(next); },
         .settings = settings});
  const Run run{messenger.clock(), messenger.waited(), rows.counts()};
  endTasks(messenger);
  return run;
}

}  // namespace

int main(int count, char** arguments) {
  const raster::ThreadLimit oneThread(1);
  const std::string file = count > 1 ? arguments[1] : HEMITEX_DATA "/gallery.obj";
  const SolverSettings settings{.residual = 0.001, .shots = count > 2 ? std::atoi(arguments[2]) : 2000};
  const double split = count > 3 ? std::atof(arguments[3]) : defaultMaxMisdirected;
  const Scene scene = loadScene(file);
  const Discretization discretization = discretize(scene, {});
  std::printf("| R | ranks | seconds | speed-up | useful rows | rank 0 waits |\n|---|---|---|---|---|---|\n");
  for (const int resolution : {128, 256, 512}) {
    MeasuredRows measured;
    simulated(8, scene, discretization, resolution, split, settings, measured);  // measures most rows
    double alone = 0;
    for (const int ranks : {1, 2, 4, 8, 16, 32, 64}) {
      const Run run = simulated(ranks, scene, discretization, resolution, split, settings, measured);
      if (ranks == 1) alone = run.seconds;
      const auto rows = static_cast<double>(run.counts.ahead);
      std::printf("| %d | %d | %.3g | %.3g | %.3g %% | %.3g %% |\n", resolution, ranks, run.seconds,
                  alone / run.seconds, rows > 0 ? 100 * static_cast<double>(run.counts.used) / rows : 100.0,
                  100 * run.waited / run.seconds);
      std::fflush(stdout);
    }
  }
}
