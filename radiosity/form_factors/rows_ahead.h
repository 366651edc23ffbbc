/// Rows that are computed before a solution needs them: those of the patches with the most unshot flux. Their flux only
/// grows until they shoot, so nearly all these rows are needed. While rank 0 shoots, other ranks compute them. Without
/// ranks a device draws many rows together, which takes less time than one by one. The order of shots is that of one
/// process. A row depends on nothing but its points, so the solution has the same bits for any number of ranks and any
/// timing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/patch_rows.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/ranks/messenger.h"

namespace hemitex::radiosity {

/// Numbers of rows.
struct RowCounts {
  std::size_t ahead = 0;       ///< computed before they were needed, by all ranks
  std::size_t used = 0;        ///< those of them that were shot along
  std::size_t ofRankZero = 0;  ///< computed by rank 0 when they were needed
};

/// The part of rank 0, or of a process that is alone. With ranks call endTasks after the solution.
class RowsAhead {
 public:
  /// `ranks` is null if this process is alone. `budget` in bytes, for rows that have arrived and are not needed yet.
  /// The arguments must outlive this object.
  RowsAhead(Messenger* ranks, SceneFormFactors& formFactors, std::size_t budget);

  /// Gives likely rows to ranks that have room for a task. Without ranks, draws the rows of likely shots if that of the
  /// next one is missing. Call it between shots. Throws RankError if a rank failed.
  void lookAhead(const NextShots& next);
  /// The row of a patch. Computes it if no rank has it, or if the rank that computes it is slow. Throws RankError.
  FormFactorRow row(const Patch& patch);

  const RowCounts& counts() const { return counts_; }

 private:
  using Points = std::vector<ViewPoint>;
  struct Task {
    std::uint32_t patch;
    Points points;
  };
  struct Row {
    Points points;
    FormFactorRow row;
  };

  void drawTogether(const NextShots& next);
  void takeMessages();
  std::size_t rowsNeeded() const;
  bool isUnderWay(std::uint32_t patch) const;
  bool isKept(std::uint32_t patch, const Points& points) const;
  FormFactorRow rowOf(const Patch& patch);
  FormFactorRow computed(const Points& points);
  std::optional<Task> nextTask(const Patches& patches, const std::vector<LikelyShot>& shots, std::size_t& place);
  bool areOthersSlow() const;
  void keep(Task task, FormFactorRow row);
  void drop(std::uint32_t patch);

  Messenger* ranks_;
  SceneFormFactors& formFactors_;
  std::size_t budget_, keptBytes_ = 0;
  std::uint64_t tasksGiven_ = 0;
  std::vector<std::size_t> tasksOf_;     ///< number of tasks that each rank holds
  std::map<std::uint64_t, Task> tasks_;  ///< by number
  std::map<std::uint32_t, Row> kept_;    ///< by patch
  double slowestRow_ = 0;                ///< seconds, on rank 0
  double shotSeconds_ = 0;               ///< of all shots of rank 0, without their rows
  double aheadSeconds_ = 0;              ///< of the rows that rank 0 has computed ahead since rowGiven_
  std::size_t shots_ = 0;
  std::optional<double> rowGiven_;  ///< when `row` returned last
  RowCounts counts_;
};

/// The answer of another rank to the bytes of a task: the number of the task and its row.
std::string resultOf(std::string_view task, ProjectedFormFactors& rows);
/// The part of the other ranks: computes rows until rank 0 ends it.
void computeRows(Messenger& ranks, ProjectedFormFactors& rows);

}  // namespace hemitex::radiosity
