/// Ratios of the runs of runs.h beside those of Nielsen and Christensen (2002): how much faster textures are than
/// regular meshing, and by how much time grows from the coarse to the fine level.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/paper/runs.h"

namespace hemitex::reference {

/// The scenes of the paper, by the names of our runs.
inline const std::string simpleScene = "simple", complexScene = "complex";

/// Seconds that the paper gives, on a Pentium III of 450 MHz. The text beside which this is made lost some numbers.
struct PublishedTimes {
  std::optional<double> total, formFactors;
};

/// Of Table 1 (the simple scene) and Table 2 (the complex one). `device` software is its software vertex processing,
/// opengl its hardware; resolution 128 its lower and 512 its higher one. Nothing where the paper has no such run.
std::optional<PublishedTimes> publishedTimes(const PaperRun& run);

/// How many times as long a shot takes in one run as in another: runs that take too long have fewer shots.
struct PaperRatio {
  PaperRun run;  ///< the other one, which is compared with
  PaperTimes ratio;
  PublishedTimes published;  ///< the same ratio of the paper's times
};
/// Regular meshing over textures, and the fine level over the coarse one. In the order of the runs that are compared
/// with; where the one to compare is missing, there is no ratio.
std::vector<PaperRatio> speedUps(const std::vector<PaperRun>& runs);
std::vector<PaperRatio> growths(const std::vector<PaperRun>& runs);

}  // namespace hemitex::reference
