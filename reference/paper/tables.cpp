#include "reference/paper/tables.h"

#include <algorithm>
#include <array>

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

/// Ratios of the times that a shot takes in two runs.
PaperTimes ratioAShot(const PaperRun& a, const PaperRun& b) {
  const double shots = static_cast<double>(b.shots) / a.shots;
  return {a.seconds.total / b.seconds.total * shots, a.seconds.formFactors / b.seconds.formFactors * shots,
          a.seconds.draw / b.seconds.draw * shots};
}

/// The run that differs from another by one member; nothing where there is none.
const PaperRun* twinOf(const std::vector<PaperRun>& runs, PaperRun run, std::string PaperRun::*member,
                       const std::string& value) {
  run.*member = value;
  const auto twin = std::find_if(runs.begin(), runs.end(), [&run](const PaperRun& other) {
    return other.scene == run.scene && other.device == run.device && other.discretize == run.discretize &&
           other.level == run.level && other.resolution == run.resolution;
  });
  return twin == runs.end() ? nullptr : &*twin;
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

std::vector<SpeedUp> speedUps(const std::vector<PaperRun>& runs) {
  std::vector<SpeedUp> result;
  for (const PaperRun& run : runs) {
    if (run.discretize != "texture") continue;
    const PaperRun* mesh = twinOf(runs, run, &PaperRun::discretize, "mesh");
    if (mesh == nullptr) continue;
    const PaperTimes times = ratioAShot(*mesh, run);
    result.push_back({run.scene, run.device, run.level, run.resolution, times.total, times.formFactors, times.draw,
                      publishedRatio(*mesh, run)});
  }
  return result;
}

std::vector<Growth> growths(const std::vector<PaperRun>& runs) {
  std::vector<Growth> result;
  for (const PaperRun& run : runs) {
    if (run.level != "coarse") continue;
    const PaperRun* fine = twinOf(runs, run, &PaperRun::level, "fine");
    if (fine == nullptr) continue;
    const PaperTimes times = ratioAShot(*fine, run);
    result.push_back({run.scene, run.device, run.discretize, run.resolution, times.total, times.formFactors, times.draw,
                      publishedRatio(*fine, run)});
  }
  return result;
}

std::vector<Promise> promises(const std::vector<PaperRun>& runs) {
  std::vector<Promise> result;
  for (const SpeedUp& speedUp : speedUps(runs)) {
    if (speedUp.scene != complexScene || speedUp.device != "software" || speedUp.level != "fine" ||
        speedUp.resolution != 128)
      continue;
    const auto promise = [&](const std::string& what, double measured) {
      result.push_back({"mesh over texture, fine, R = 128: " + what, measured, 13.3, measured >= 13.3});
    };
    promise("total time", speedUp.total);
    promise("form-factor time", speedUp.formFactors);
  }
  for (const Growth& growth : growths(runs)) {
    if (growth.scene != complexScene || growth.device != "software" || growth.discretize != "texture") continue;
    const std::string where = "texture, fine over coarse, R = " + std::to_string(growth.resolution) + ": ";
    result.push_back({where + "drawing time", growth.draw, 1.05, growth.draw < 1.05});
    const double limit = growth.resolution == 128 ? 1.18 : 1.05;
    result.push_back({where + "form-factor time", growth.formFactors, limit, growth.formFactors <= limit});
  }
  return result;
}

}  // namespace hemitex::reference
