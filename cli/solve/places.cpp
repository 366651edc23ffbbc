#include "cli/solve/places.h"

#include "radiosity/textures/texture_layout.h"

namespace hemitex::cli {

std::set<std::string> outputNames(const SolveOptions& options, const radiosity::Scene& scene,
                                  const radiosity::Discretization& discretization, std::size_t frames) {
  std::set<std::string> names{"scene.view.json", "render.png", "solution.json", "report.html"};
  if (!options.noElements) names.insert("elements.csv");
  if (!options.noTextures) {
    names.insert({"scene.obj", "scene.mtl", "scene.glb"});
    for (const std::string& texture : radiosity::layOutTextures(scene, discretization, magnificationOf(options)).names)
      names.insert({texture + ".png", texture + ".exr"});
  }
  const std::set<std::string> ofFrame = names;
  for (std::size_t f = 1; f <= frames; ++f)
    for (const std::string& name : ofFrame) names.insert("frame-" + std::to_string(f) + "/" + name);
  return names;
}

std::set<std::filesystem::path> inputFiles(const SolveOptions& options, const radiosity::Scene& scene,
                                           const std::vector<Frame>& frames) {
  std::set<std::filesystem::path> files(scene.files.begin(), scene.files.end());
  for (const Frame& frame : frames) files.insert(frame.files.begin(), frame.files.end());
  files.insert({viewFileOf(options.scene.file), options.scene.materials.lightsFile, options.edits});
  files.erase(std::filesystem::path());
  return files;
}

}  // namespace hemitex::cli
