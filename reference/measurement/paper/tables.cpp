#include "reference/measurement/paper/tables.h"

#include <tuple>

namespace hemitex::reference {
namespace {

struct PublishedRow {
  const char *scene, *discretize, *level;
  int resolution;
  PublishedTimes software, opengl;
};

const std::vector<PublishedRow> publishedRows{
    {"simple", "mesh", "coarse", 128, {4.8, 4.6}, {3.6, 3.6}},
    {"simple", "mesh", "medium", 128, {5.9, 5.6}, {4.0, 3.8}},
    {"simple", "mesh", "fine", 128, {8.1, 7.7}, {4.4, 4.0}},
    {"simple", "mesh", "coarse", 512, {9.1, 8.9}, {8.4, 8.3}},
    {"simple", "mesh", "medium", 512, {11.4, 11.2}, {8.6, 8.4}},
    {"simple", "mesh", "fine", 512, {21.1, 20.4}, {14.8, 14.0}},
    {"simple", "texture", "coarse", 128, {3.4, 3.2}, {3.2, 3.2}},
    {"simple", "texture", "medium", 128, {3.5, 3.2}, {3.4, 3.2}},
    {"simple", "texture", "fine", 128, {3.6, 3.2}, {3.6, 3.2}},
    {"simple", "texture", "coarse", 512, {8.5, 8.4}, {8.4, 8.3}},
    {"simple", "texture", "medium", 512, {8.7, 8.5}, {8.6, 8.4}},
    {"simple", "texture", "fine", 512, {9.4, 8.6}, {9.3, 8.5}},
    {"complex", "mesh", "coarse", 128, {21.3, 18.9}, {6.7, 5.7}},
    {"complex", "mesh", "medium", 128, {61.4, 59.5}, {13.4, 12.3}},
    {"complex", "mesh", "fine", 128, {193, 186}, {114, 108}},
    {"complex", "mesh", "coarse", 512, {31.9, 30.4}, {20.8, 18.8}},
    {"complex", "mesh", "medium", 512, {std::nullopt, 102}, {26.3, 23.9}},
    {"complex", "mesh", "fine", 512, {std::nullopt, 294}, {std::nullopt, 141}},
    {"complex", "texture", "coarse", 128, {9.0, 6.6}, {4.9, 3.9}},
    {"complex", "texture", "medium", 128, {9.7, 7.8}, {5.2, 4.1}},
    {"complex", "texture", "fine", 128, {14.5, 7.8}, {9.9, 4.1}},
    {"complex", "texture", "coarse", 512, {20.9, 19.4}, {16.8, 14.8}},
    {"complex", "texture", "medium", 512, {21.5, 19.4}, {17.2, 14.8}},
    {"complex", "texture", "fine", 512, {26.1, 19.4}, {21.9, 14.8}}};

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
  for (const PublishedRow& row : publishedRows)
    if (row.scene == run.scene && row.discretize == run.discretize && row.level == run.level &&
        row.resolution == run.resolution)
      return run.device == "software" ? row.software : row.opengl;
  return std::nullopt;
}

std::vector<PaperRatio> speedUps(const std::vector<PaperRun>& runs) {
  return ratios(runs, &PaperRun::discretize, "mesh", "texture");
}

std::vector<PaperRatio> growths(const std::vector<PaperRun>& runs) {
  return ratios(runs, &PaperRun::level, "fine", "coarse");
}

}  // namespace hemitex::reference
