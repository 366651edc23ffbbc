#include "reference/measurement/paper/tables.h"

#include <array>
#include <tuple>

namespace hemitex::reference {
namespace {

using Pair = PublishedTimes;

/// A row of a table: coarse, medium and fine.
struct PublishedRow {
  const char *scene, *discretize;
  int resolution;
  std::array<Pair, 3> software, opengl;
};

const std::vector<PublishedRow>& publishedRows() {
  static const std::vector<PublishedRow> rows{
      {"simple", "mesh", 128, {Pair{4.8, 4.6}, {5.9, 5.6}, {8.1, 7.7}}, {Pair{3.6, 3.6}, {4.0, 3.8}, {4.4, 4.0}}},
      {"simple", "mesh", 512, {Pair{9.1, 8.9}, {11.4, 11.2}, {21.1, 20.4}}, {Pair{8.4, 8.3}, {8.6, 8.4}, {14.8, 14.0}}},
      {"simple", "texture", 128, {Pair{3.4, 3.2}, {3.5, 3.2}, {3.6, 3.2}}, {Pair{3.2, 3.2}, {3.4, 3.2}, {3.6, 3.2}}},
      {"simple", "texture", 512, {Pair{8.5, 8.4}, {8.7, 8.5}, {9.4, 8.6}}, {Pair{8.4, 8.3}, {8.6, 8.4}, {9.3, 8.5}}},
      {"complex",
       "mesh",
       128,
       {Pair{21.3, 18.9}, {61.4, 59.5}, {193, 186}},
       {Pair{6.7, 5.7}, {13.4, 12.3}, {114, 108}}},
      {"complex",
       "mesh",
       512,
       {Pair{31.9, 30.4}, {std::nullopt, 102}, {std::nullopt, 294}},
       {Pair{20.8, 18.8}, {26.3, 23.9}, {std::nullopt, 141}}},
      {"complex", "texture", 128, {Pair{9.0, 6.6}, {9.7, 7.8}, {14.5, 7.8}}, {Pair{4.9, 3.9}, {5.2, 4.1}, {9.9, 4.1}}},
      {"complex",
       "texture",
       512,
       {Pair{20.9, 19.4}, {21.5, 19.4}, {26.1, 19.4}},
       {Pair{16.8, 14.8}, {17.2, 14.8}, {21.9, 14.8}}}};
  return rows;
}

std::optional<double> ratio(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(*a / *b) : std::nullopt;
}

/// Ratios of the published times of two runs.
PublishedTimes publishedRatio(const PaperRun& a, const PaperRun& b) {
  const PublishedTimes of = publishedTimes(a).value_or(PublishedTimes{}),
                       over = publishedTimes(b).value_or(PublishedTimes{});
  return {ratio(of.total, over.total), ratio(of.formFactors, over.formFactors)};
}

PaperTimes ratioPerShot(const PaperRun& a, const PaperRun& b) {
  const double shots = static_cast<double>(b.shots) / a.shots;
  return {a.seconds.total / b.seconds.total * shots, a.seconds.formFactors / b.seconds.formFactors * shots,
          a.seconds.draw / b.seconds.draw * shots};
}

/// Ratios of runs whose `member` is `value` over the runs with `base` instead that are otherwise equal.
std::vector<PaperRatio> ratios(const std::vector<PaperRun>& runs, std::string PaperRun::*member,
                               const std::string& value, const std::string& base) {
  const auto cell = [](const PaperRun& run) {
    return std::tie(run.scene, run.device, run.discretize, run.level, run.resolution);
  };
  std::vector<PaperRatio> result;
  for (const PaperRun& run : runs) {
    if (run.*member != base) continue;
    PaperRun wanted = run;
    wanted.*member = value;
    for (const PaperRun& other : runs)
      if (cell(other) == cell(wanted)) result.push_back({run, ratioPerShot(other, run), publishedRatio(other, run)});
  }
  return result;
}

}  // namespace

std::optional<PublishedTimes> publishedTimes(const PaperRun& run) {
  for (const PublishedRow& row : publishedRows())
    if (row.scene == run.scene && row.discretize == run.discretize && row.resolution == run.resolution) {
      const std::size_t level = run.level == "coarse" ? 0 : run.level == "medium" ? 1 : 2;
      return run.device == "software" ? row.software[level] : row.opengl[level];
    }
  return std::nullopt;
}

std::vector<PaperRatio> speedUps(const std::vector<PaperRun>& runs) {
  return ratios(runs, &PaperRun::discretize, "mesh", "texture");
}

std::vector<PaperRatio> growths(const std::vector<PaperRun>& runs) {
  return ratios(runs, &PaperRun::level, "fine", "coarse");
}

}  // namespace hemitex::reference
