/// Options that several commands share: how they are read, checked and turned into what the library asks for. A value
/// that is no number, or outside its range, is a usage error that names the option.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/common/command_line.h"
#include "cli/common/console.h"
#include "cli/common/numbers.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"
#include "raster/interface/item_id.h"

namespace hemitex::cli {

/// What every command knows. A command that was given leaves its work in `command`, which the program calls once the
/// whole line is read.
struct Context {
  Console console;
  bool json = false;
  int threads = 0;  ///< 0: all cores
  std::function<void()> command;
  bool failed = false;  ///< set by a command whose comparison or verification failed
};

/// The whole number in [low, high] that an option was given. Throws a usage error.
int integerOption(const std::string& name, const std::string& text, int low, int high);
/// The number above 0 and below `limit` (which may be infinite) that an option was given. Throws a usage error.
double positiveOption(const std::string& name, const std::string& text, double limit);
/// The vector that an option was given. Throws a usage error.
glm::dvec3 vectorOption(const std::string& name, const std::string& text);

/// An option with a whole number in [low, high]. `target` is an int or may hold one.
template <typename Target>
Option addInteger(Command command, const std::string& name, Target& target, int low, int high,
                  const std::string& help) {
  const auto read = [&target, name, low, high](const std::string& text) {
    target = integerOption(name, text, low, high);
  };
  return command.addText(name, "N", help, read);
}

/// An option with a number above 0 and below `limit`. `target` is a double or may hold one.
template <typename Target>
Option addPositive(Command command, const std::string& name, Target& target, double limit, const std::string& help) {
  const auto read = [&target, name, limit](const std::string& text) { target = positiveOption(name, text, limit); };
  return command.addText(name, "X", help, read);
}

/// An option with a vector `x,y,z`. `target` is a vector or may hold one.
template <typename Target>
Option addVectorOption(Command command, const std::string& name, Target& target, const std::string& help) {
  const auto read = [&target, name](const std::string& text) { target = vectorOption(name, text); };
  return command.addText(name, "x,y,z", help, read);
}

/// An option with one of several words, each of which stands for a value.
template <typename Value>
Option addChoice(Command command, const std::string& name, Value& target,
                 const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) {
  std::string words;
  for (const auto& choice : choices) words += (words.empty() ? "" : "|") + choice.first;
  const auto read = [&target, name, choices, words](const std::string& text) {
    for (const auto& choice : choices)
      if (choice.first == text) {
        target = choice.second;
        return;
      }
    usageError(name, "`" + text + "` is none of " + words);
  };
  return command.addText(name, words, help, read);
}

/// The scene, and how it is read.
struct SceneOptions {
  std::filesystem::path file;
  radiosity::SceneSettings settings;
};
void addSceneOptions(Command command, SceneOptions& options);
/// The scene; what was mended in it is told as warnings.
radiosity::Scene sceneOf(const SceneOptions& options, Console& console);

/// How surfaces become elements and patches.
void addDiscretizationOptions(Command command, radiosity::DiscretizationSettings& settings);
/// Throws InputError, with names that come near, where a surface that was named is not in the scene.
radiosity::Discretization discretizationOf(const radiosity::DiscretizationSettings& settings,
                                           const radiosity::Scene& scene);

/// How elements become words.
void addIdOptions(Command command, radiosity::IdSettings& settings);
std::string nameOf(radiosity::IndexMaps indexMaps);
/// Throws InputError as radiosity::layOut, and where options of offsets come with unique index maps, which have none.
radiosity::IdLayout layoutOf(const radiosity::IdSettings& settings, const radiosity::Discretization& discretization,
                             Console& console);

/// `--resolution`: pixels along the side of a face, even, 2 to 4096.
Option addResolution(Command command, int& resolution);
/// The same, repeatable.
Option addResolutions(Command command, std::vector<int>& resolutions);

/// How projections look at the scene, all but which of them does.
void addDrawingOptions(Command command, radiosity::DrawingSettings& settings);
std::string nameOf(radiosity::Orientation orientation);
std::string nameOf(radiosity::ElementsBy elementsBy);

/// `--method` of what finds rows by drawing: `hemicube`, `single-plane` and `tetrahedron`; nothing for other methods.
std::optional<radiosity::ProjectionKind> projectionNamed(const std::string& method);

/// What projections are drawn with: their options and those of words.
std::vector<std::string> drawingOptionNames();
/// Throws a usage error where one of the options was given though a method has no use for it.
void refuseUnused(Command command, const std::vector<std::string>& options, const std::string& method);

/// `-o`, required.
Option addOutput(Command command, std::filesystem::path& output, const std::string& help);

}  // namespace hemitex::cli
