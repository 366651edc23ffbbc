/// `hemitex view`: opens the page of a solved folder in the browser. A folder without a page gets one, made of its
/// files.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/report/solved_page.h"
#include "cli/scene/lit_surfaces.h"
#include "cli/scene/sealed_folder.h"
#include "cli/view/browser.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
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
  radiosity::Scene lit = radiosity::loadScene(sceneFile, {});
  const auto solution = reference::parseJson<ordered_json>(text, (solved / "solution.json").string());
  try {
    const std::vector<std::uint32_t> numbers = restoreSurfaces(lit, solution.at("surfaces"));
    return solvedPage({solved / "scene.glb", std::move(lit), numbers}, solution);
  } catch (const std::exception&) {
    throw raster::InputError((solved / "solution.json").string(), 0, "does not belong to the scene beside it",
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
  Staging staging({.place = folder, .writer = solveWriter});
  raster::writeFile(staging.folder() / pageName, pageOf(folder));
  staging.commit();
}

void view(const fs::path& folder, Context& context) {
  const fs::path page = folder / pageName;
  if (!fs::exists(page)) writePage(folder);
  const bool isOpened = openInBrowser(page, context.console);
  if (context.json)
    std::cout << toText({{"page", page.string()}, {"opened", isOpened}});
  else
    std::cout << page.string() << '\n';
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
