#include "radiosity/form_factors/rows_ahead.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "radiosity/base/bytes.h"
#include "radiosity/ranks/shared_tasks.h"

namespace hemitex::radiosity {
namespace {

/// Tasks that a rank holds: the one that it computes and the next one.
constexpr std::size_t tasksPerRank = 2;
/// Limits of likely shots, rows that arrived and rows under way, per other rank and beyond what a shot waits for. More
/// would compute more rows in vain.
constexpr std::size_t shotsPerRank = 4, spareShots = 8;
/// Rank 0 waits for the row of another rank at most this number of times as long as it would compute the row.
constexpr double patience = 2;
/// Rows that are drawn together, and rows that are kept then: among them those of patches that shoot later than
/// expected, or from other points.
constexpr std::size_t rowsAtOnce = 64, rowsKept = 8 * rowsAtOnce;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::size_t bytesOf(const FormFactorRow& row) {
  return row.elements.size() * (sizeof(row.elements[0]) + sizeof(row.shares[0]));
}

void append(std::string& bytes, const FormFactorRow& row) {
  appendBytes(bytes, row.elements);
  appendBytes(bytes, row.shares);
  appendBytes(bytes, row.background);
  appendBytes(bytes, row.back);
}

FormFactorRow takeRow(std::string_view& bytes) {
  return {takeValue<std::vector<std::uint32_t>>(bytes), takeValue<std::vector<std::uint64_t>>(bytes),
          takeValue<std::uint64_t>(bytes), takeValue<std::uint64_t>(bytes)};
}

}  // namespace

RowsAhead::RowsAhead(Messenger* ranks, SceneFormFactors& formFactors, std::size_t budget)
    : ranks_(ranks),
      formFactors_(formFactors),
      budget_(budget),
      tasksOf_(ranks ? static_cast<std::size_t>(ranks->ranks()) : 1) {}

void RowsAhead::drawTogether(const NextShots& next) {
  const std::vector<LikelyShot> first = next.likely(1);
  if (first.empty() || kept_.contains(first.front().patch)) return;
  if (kept_.size() > rowsKept) {
    kept_.clear();
    keptBytes_ = 0;
  }
  const std::vector<LikelyShot> shots = next.likely(rowsAtOnce);
  std::size_t place = 0;
  std::vector<std::uint32_t> patches;
  std::vector<Points> points;
  while (std::optional<Task> task = nextTask(next.patches, shots, place)) {
    if (patches.empty() && task->patch != shots.front().patch) return;  // the next patch is split first
    patches.push_back(task->patch);
    points.push_back(std::move(task->points));
  }
  std::vector<FormFactorRow> rows = formFactors_.uncorrected().ofManyPoints(points);
  for (std::size_t r = 0; r < rows.size(); ++r) keep({patches[r], std::move(points[r])}, std::move(rows[r]));
}

void RowsAhead::takeMessages() {
  while (const auto message = received(*ranks_)) {
    std::string_view bytes = message->bytes;
    const auto number = takeValue<std::uint64_t>(bytes);
    --tasksOf_[static_cast<std::size_t>(message->from)];
    ++counts_.ahead;
    const auto task = tasks_.find(number);
    if (task == tasks_.end()) continue;  // rank 0 has computed the row
    keep(std::move(task->second), takeRow(bytes));
    tasks_.erase(task);
  }
}

void RowsAhead::keep(Task task, FormFactorRow row) {
  drop(task.patch);
  keptBytes_ += bytesOf(row);
  kept_.insert_or_assign(task.patch, Row{std::move(task.points), std::move(row)});
}

void RowsAhead::drop(std::uint32_t patch) {
  const auto old = kept_.find(patch);
  if (old == kept_.end()) return;
  keptBytes_ -= bytesOf(old->second.row);
  kept_.erase(old);
}

/// The number of shots to look ahead: about twice those that rank 0 shoots while another rank computes a row.
std::size_t RowsAhead::rowsNeeded() const {
  const std::size_t limit = shotsPerRank * (tasksOf_.size() - 1) + 1;
  if (shots_ == 0) return limit;
  const double shotsPerRow = slowestRow_ * static_cast<double>(shots_) / shotSeconds_;
  return static_cast<std::size_t>(std::min(static_cast<double>(limit), spareShots + 2 * shotsPerRow));
}

bool RowsAhead::isUnderWay(std::uint32_t patch) const {
  return std::any_of(tasks_.begin(), tasks_.end(), [&](const auto& task) { return task.second.patch == patch; });
}

bool RowsAhead::isKept(std::uint32_t patch, const Points& points) const {
  const auto found = kept_.find(patch);
  return found != kept_.end() && found->second.points == points;
}

void RowsAhead::lookAhead(const NextShots& next) {
  if (!ranks_) return drawTogether(next);
  takeMessages();
  if (tasksOf_.size() == 1 || keptBytes_ >= budget_) return;
  const std::size_t needed = rowsNeeded();
  const std::size_t fewest = *std::min_element(tasksOf_.begin() + 1, tasksOf_.end());
  const bool isRoom = fewest < tasksPerRank;
  if (!isRoom && !areOthersSlow()) return;
  const std::vector<LikelyShot> shots = next.likely(needed);
  std::size_t place = 0;
  for (std::size_t held = fewest; isRoom && held < tasksPerRank; ++held)
    for (std::size_t rank = 1; rank < tasksOf_.size(); ++rank) {
      if (tasksOf_[rank] > held) continue;
      std::optional<Task> task = nextTask(next.patches, shots, place);
      if (!task) break;
      std::string message;
      appendBytes(message, tasksGiven_);
      appendBytes(message, task->points);
      ranks_->send(static_cast<int>(rank), MessageKind::Task, std::move(message));
      tasks_[tasksGiven_++] = *std::move(task);
      ++tasksOf_[rank];
    }
  if (!areOthersSlow() || shots.empty() || !isUnderWay(shots.front().patch)) return;
  if (std::optional<Task> task = nextTask(next.patches, shots, place)) {
    const double start = seconds();
    FormFactorRow row = computed(task->points);
    keep(*std::move(task), std::move(row));
    aheadSeconds_ += seconds() - start;
    ++counts_.ahead;
  }
}

/// The first likely shot from `place` on whose row no rank has or computes.
std::optional<RowsAhead::Task> RowsAhead::nextTask(const Patches& patches, const std::vector<LikelyShot>& shots,
                                                   std::size_t& place) {
  while (place < shots.size()) {
    const LikelyShot& shot = shots[place++];
    if (shot.weight == 0) return std::nullopt;  // its row will have another resolution, as will those of the rest
    if (kept_.contains(shot.patch) || isUnderWay(shot.patch)) continue;
    Points points = formFactors_.likelyPoints(patches, patches.list[shot.patch], shot.weight);
    if (!points.empty()) return Task{shot.patch, std::move(points)};
  }
  return std::nullopt;
}

/// Whether rank 0 shoots faster than the other ranks compute rows, so that it computes rows ahead, too.
bool RowsAhead::areOthersSlow() const {
  const auto others = static_cast<double>(tasksOf_.size() - 1);
  return shots_ > 0 && others * shotSeconds_ / static_cast<double>(shots_) < slowestRow_;
}

FormFactorRow RowsAhead::computed(const Points& points) {
  const double start = seconds();
  FormFactorRow row = formFactors_.uncorrected().ofPoints(points);
  slowestRow_ = std::max(slowestRow_, seconds() - start);
  return row;
}

FormFactorRow RowsAhead::row(const Patch& patch) {
  if (rowGiven_) {
    shotSeconds_ += seconds() - *rowGiven_ - aheadSeconds_;
    ++shots_;
  }
  aheadSeconds_ = 0;
  FormFactorRow drawn = rowOf(patch);
  FormFactorRow row = formFactors_.corrected(patch, drawn).value_or(std::move(drawn));
  rowGiven_ = seconds();
  return row;
}

FormFactorRow RowsAhead::rowOf(const Patch& requested) {
  const std::uint32_t patch = requested.number;
  const Points points = formFactors_.uncorrected().pointsOfPatch(requested);
  const double start = seconds();
  while (isUnderWay(patch) && seconds() - start < patience * slowestRow_) {
    takeMessages();
    std::this_thread::yield();
  }
  if (!isKept(patch, points)) {
    std::erase_if(tasks_, [&](const auto& task) { return task.second.patch == patch; });
    drop(patch);
    ++counts_.ofRankZero;
    return computed(points);
  }
  FormFactorRow row = std::move(kept_.at(patch).row);
  keptBytes_ -= bytesOf(row);
  kept_.erase(patch);
  ++counts_.used;
  return row;
}

std::string resultOf(std::string_view task, ProjectedFormFactors& rows) {
  std::string result(takeBytes(task, sizeof(std::uint64_t)));
  append(result, rows.ofPoints(takeValue<std::vector<ViewPoint>>(task)));
  return result;
}

void computeRows(Messenger& ranks, ProjectedFormFactors& rows) {
  answerTasks(ranks, [&rows](std::string_view task) { return resultOf(task, rows); });
}

}  // namespace hemitex::radiosity
