/// Computes ratios of the runs of runs.h, beside those of Nielsen and Christensen (2002): the speed-up of textures over
/// regular meshing, and the growth of time from the coarse to the fine level.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/measurement/paper/runs.h"

namespace hemitex::reference {

/// The names of the scenes of the paper in our runs.
inline const std::string simpleScene = "simple", complexScene = "complex";

/// Seconds in the paper, on a Pentium III of 450 MHz. A value is missing if it is illegible in our copy.
struct PublishedTimes {
  std::optional<double> total, formFactors;
};

/// The times of Table 1 (simple scene) or Table 2 (complex scene) for a run. `device` software stands for software
/// vertex processing, others for hardware. Resolutions 128 and 512 stand for the lower and the higher resolution of the
/// paper. Nothing if the paper has no such run.
std::optional<PublishedTimes> publishedTimes(const PaperRun& run);

/// The time of a shot in one run over that in another. Ratios are per shot, because long runs have fewer shots.
struct PaperRatio {
  PaperRun run;  ///< the other run, the denominator
  PaperTimes ratio;
  PublishedTimes published;  ///< the same ratio in the paper
};
/// Ratios of regular meshing over textures, and of the fine level over the coarse one. They are in the order of the
/// denominators; a run without a counterpart has no ratio.
std::vector<PaperRatio> speedUps(const std::vector<PaperRun>& runs);
std::vector<PaperRatio> growths(const std::vector<PaperRun>& runs);

}  // namespace hemitex::reference
