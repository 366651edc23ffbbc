/// Options that several commands share: how they are read, checked and turned into what the library asks for. A value
/// that is no number, or outside its range, is a usage error that names the option.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// The whole number in [low, high] that an option was given. Throws CLI::ValidationError.
int integerOption(const std::string& name, const std::string& text, int low, int high);
/// The number above 0 and below `limit` (which may be infinite) that an option was given. Throws CLI::ValidationError.
double positiveOption(const std::string& name, const std::string& text, double limit);
/// The vector that an option was given. Throws CLI::ValidationError.
glm::dvec3 vectorOption(const std::string& name, const std::string& text);

/// An option with a whole number in [low, high]. `target` is an int or may hold one.
template <typename Target>
CLI::Option* addInteger(CLI::App& app, const std::string& name, Target& target, int low, int high,
                        const std::string& help) {
  const auto read = [&target, name, low, high](const std::string& text) {
    target = integerOption(name, text, low, high);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("N");
}

/// An option with a number above 0 and below `limit`. `target` is a double or may hold one.
template <typename Target>
CLI::Option* addPositive(CLI::App& app, const std::string& name, Target& target, double limit,
                         const std::string& help) {
  const auto read = [&target, name, limit](const std::string& text) { target = positiveOption(name, text, limit); };
  return app.add_option_function<std::string>(name, read, help)->type_name("X");
}

/// An option with a vector `x,y,z`. `target` is a vector or may hold one.
template <typename Target>
CLI::Option* addVectorOption(CLI::App& app, const std::string& name, Target& target, const std::string& help) {
  const auto read = [&target, name](const std::string& text) { target = vectorOption(name, text); };
  return app.add_option_function<std::string>(name, read, help)->type_name("x,y,z");
}

/// An option with one of several words, each of which stands for a value.
template <typename Value>
CLI::Option* addChoice(CLI::App& app, const std::string& name, Value& target,
                       const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) {
  std::string words;
  for (const auto& choice : choices) words += (words.empty() ? "" : "|") + choice.first;
  const auto read = [&target, name, choices, words](const std::string& text) {
    for (const auto& choice : choices)
      if (choice.first == text) {
        target = choice.second;
        return;
      }
    throw CLI::ValidationError(name, "`" + text + "` is none of " + words);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name(words);
}

/// The scene, and how it is read.
struct SceneOptions {
  std::filesystem::path file;
  radiosity::SceneSettings settings;
};
void addSceneOptions(CLI::App& app, SceneOptions& options);
/// The scene; what was mended in it is told as warnings.
radiosity::Scene sceneOf(const SceneOptions& options, Console& console);

/// How surfaces become elements and patches.
void addDiscretizationOptions(CLI::App& app, radiosity::DiscretizationSettings& settings);
/// Throws InputError, with names that come near, where a surface that was named is not in the scene.
radiosity::Discretization discretizationOf(const radiosity::DiscretizationSettings& settings,
                                           const radiosity::Scene& scene);

/// How elements become words.
void addIdOptions(CLI::App& app, radiosity::IdSettings& settings);
std::string nameOf(radiosity::IndexMaps indexMaps);
/// Throws InputError as radiosity::layOut, and where options of offsets come with unique index maps, which have none.
radiosity::IdLayout layoutOf(const radiosity::IdSettings& settings, const radiosity::Discretization& discretization,
                             Console& console);

/// `--resolution`: pixels along the side of a face, even, 2 to 4096.
CLI::Option* addResolution(CLI::App& app, int& resolution);
/// The same, repeatable.
CLI::Option* addResolutions(CLI::App& app, std::vector<int>& resolutions);

/// How projections look at the scene, all but which of them does.
void addDrawingOptions(CLI::App& app, radiosity::DrawingSettings& settings);
std::string nameOf(radiosity::Orientation orientation);
std::string nameOf(radiosity::ElementsBy elementsBy);

/// `--method` of what finds rows by drawing: `hemicube`, `single-plane` and `tetrahedron`; nothing for other methods.
std::optional<radiosity::ProjectionKind> projectionNamed(const std::string& method);

/// What projections are drawn with: their options and those of words.
std::vector<std::string> drawingOptionNames();
/// Throws CLI::ValidationError where one of the options was given though a method has no use for it.
void refuseUnused(const CLI::App& app, const std::vector<std::string>& options, const std::string& method);

/// `-o`, required.
CLI::Option* addOutput(CLI::App& app, std::filesystem::path& output, const std::string& help);

}  // namespace hemitex::cli
