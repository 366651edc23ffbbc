/// The folder of a lit scene that `hemitex solve` writes, but for its solution.json.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/common/console.h"
#include "cli/solve/solution_json.h"

namespace hemitex::cli {

struct Convergence;
struct ShownScene;

/// The names of all files of a result, relative to its folder. Those of a frame are as if its edits added no surface.
std::set<std::string> outputNames(const SolveOptions& options, const radiosity::Scene& scene,
                                  const radiosity::Discretization& discretization, std::size_t frames);

/// The given exposure, or that of the picture (see pictureExposure).
double exposureOf(const SolvedScene& solved);

/// The light that --gather asks for; nothing without, and after a signal. Shows its progress.
std::optional<radiosity::GatheredLight> gatheredLight(const SolvedScene& solved, Console& console);

/// The lit scene, with the display textures of the options; nothing with --no-textures.
std::optional<radiosity::LitScene> litScene(const SolvedScene& solved);

/// Writes the lit scene if there is one, its picture and elements.csv. Returns warnings for the user.
std::vector<std::string> writeSolved(const std::filesystem::path& folder, const SolvedScene& solved,
                                     const std::optional<radiosity::LitScene>& lit);

/// What the page shows of a scene that writeSolved wrote into a folder; `lit` is the scene of its LitScene.
ShownScene shownScene(const std::filesystem::path& folder, const SolvedScene& solved, radiosity::Scene lit,
                      const Convergence& convergence);

/// Says where the files are.
std::string filesText(const SolveOptions& options);

}  // namespace hemitex::cli
