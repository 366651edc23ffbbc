/// `hemitex view`: opens the page of a solved folder in the browser. A folder without a page gets one, made of its
/// files.
#include <boost/algorithm/string.hpp>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/report/solved_page.h"
#include "cli/scene/sealed_folder.h"
#include "cli/scene/surface_names.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/child_process.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

const char* const pageName = "report.html";

/// The page of a solved folder. Throws InputError if its files do not allow that.
std::string pageOf(const fs::path& solved) {
  const fs::path sceneFile = solved / "scene.obj";
  const std::string text = raster::readFile(solved / "solution.json");
  const radiosity::Scene lit = radiosity::loadScene(sceneFile, {});
  try {
    const ordered_json solution = reference::parseJson<ordered_json>(text);
    // The lit scene has one group per surface, in order; a group may have several planar parts.
    return solvedPage({solved / "scene.glb", lit, familiesOf(lit).ofSurface}, solution);
  } catch (const std::exception& error) {
    throw raster::InputError((solved / "solution.json").string(), 0,
                             std::string("does not belong to the scene beside it: ") + error.what(),
                             "solve the scene again with --report");
  }
}

void writePage(const fs::path& folder) {
  requireLitScene(folder);
  for (const char* name : {"scene.obj", "solution.json"})
    if (!fs::exists(folder / name))
      throw raster::InputError(folder.string(), 0, std::string("has neither ") + pageName + " nor " + name,
                               "solve a scene into this folder with --report");
  requireIntact(folder);
  Staging staging(folder);
  raster::writeFile(staging.folder() / pageName, pageOf(folder));
  staging.commit();
}

std::vector<std::string> splitAt(const std::string& text, const char* separator) {
  std::vector<std::string> parts;
  boost::split(parts, text, boost::is_any_of(separator));
  std::erase(parts, "");
  return parts;
}

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

/// The words of a command, with the path of the file.
std::vector<std::string> wordsOf(const std::string& command, const std::string& path) {
  std::vector<std::string> words = splitAt(command, " ");
  if (command.find("%s") == std::string::npos) words.push_back(path);
  for (std::string& word : words) boost::replace_first(word, "%s", path);
  return words;
}

/// The commands that open a file, in the order in which to try them: those of `$BROWSER` (a list separated by `:`),
/// else `xdg-open` or `open`. Empty if there is neither `$BROWSER` nor a display, so that no window can appear.
std::vector<std::string> browserCommands() {
  if (isSet("BROWSER")) return splitAt(std::getenv("BROWSER"), ":");
#ifdef __APPLE__
  return {"open"};
#else
  if (isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")) return {"xdg-open"};
  return {};
#endif
}

/// Starts one of the commands with the path of the file, which replaces `%s` or is appended. Waits at most two seconds
/// for it to end. Returns the command that runs or ended with exit code 0; nothing if none did.
std::optional<std::string> openInBrowser(const std::vector<std::string>& commands, const std::filesystem::path& file) {
  for (const std::string& command : commands)
    if (reference::startDetached(wordsOf(command, std::filesystem::absolute(file).string()), std::chrono::seconds(2)))
      return command;
  return std::nullopt;
}

void view(const fs::path& folder, Context& context) {
  const fs::path page = folder / pageName;
  if (!fs::exists(page)) writePage(folder);
  const std::vector<std::string> commands = browserCommands();
  const std::optional<std::string> opened = openInBrowser(commands, page);
  if (context.json)
    std::cout << toText({{"page", page.string()}, {"opened", opened.has_value()}});
  else
    std::cout << page.string() << '\n';
  if (opened) return;
  context.console.message(commands.empty() ? "there is no display and no $BROWSER; open the page yourself"
                                           : "no browser could be started (" + boost::join(commands, ", ") +
                                                 "); open the page yourself");
}

}  // namespace

void addView(Command program, Context& context) {
  const auto folder = std::make_shared<fs::path>();
  const Command command = program.addCommand(
      "view", "Open the page of a solved folder in the browser ($BROWSER, else xdg-open or open), and print its path");
  command.addPath("DIR", *folder, "folder that solve wrote; without report.html the page is made of its other files")
      .required();
  command.addExamples({"lit", "--json lit"});
  command.onRead([folder, &context] { context.command = [folder, &context] { view(*folder, context); }; });
}

}  // namespace hemitex::cli
