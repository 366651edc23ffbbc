/// What the runs of runs.h say, beside what Nielsen and Christensen (2002) say: their tables, how much faster
/// textures are than regular meshing, and by how much time grows from the coarse to the fine level.
///
/// Times of two runs are compared shot by shot, since runs that take too long have fewer shots.
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

/// The time of regular meshing over that of textures.
struct SpeedUp {
  std::string scene, device, level;
  int resolution = 0;
  double total = 0, formFactors = 0, draw = 0;
  PublishedTimes published;  ///< the same ratios of the paper's times
};
/// In the order of the runs by textures; a run that the other method lacks is left out.
std::vector<SpeedUp> speedUps(const std::vector<PaperRun>& runs);

/// The time at the fine level over that at the coarse one.
struct Growth {
  std::string scene, device, discretize;
  int resolution = 0;
  double total = 0, formFactors = 0, draw = 0;
  PublishedTimes published;
};
/// In the order of the coarse runs; one that lacks a fine one is left out.
std::vector<Growth> growths(const std::vector<PaperRun>& runs);

/// Something that the method promises on the complex scene.
struct Promise {
  std::string what;
  double measured = 0, limit = 0;
  bool isKept = false;
};
/// On the reference renderer: textures are 13.3 times faster than meshing (193 / 14.5) at the fine level and the lower
/// resolution; from coarse to fine their drawing takes less than 5 % more, and their form factors at most 18 % more at
/// the lower and 5 % at the higher resolution. What was not run is left out.
std::vector<Promise> promises(const std::vector<PaperRun>& runs);

}  // namespace hemitex::reference
