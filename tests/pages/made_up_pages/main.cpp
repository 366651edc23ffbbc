/// The pages of `hemitex paper` and `hemitex bench` without their minutes of work, for made_up_pages_check.cmake.
///   hemitex_made_up_pages DIR
#include <fstream>

#include "cli/bench/report.h"
#include "cli/paper/report.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "radiosity/images/image.h"

using namespace hemitex;

namespace {

/// Meshing takes as long as it has elements, and textures always the same.
std::vector<reference::PaperRun> paperRuns() {
  std::vector<reference::PaperRun> result;
  for (const std::string scene : {"simple", "complex", "plant"})
    for (const std::string discretize : {"texture", "mesh"}) {
      std::size_t elements = 1000;
      for (const std::string level : {"coarse", "medium", "fine"}) {
        for (const int resolution : {128, 512}) {
          const double draw = discretize == "mesh" ? 1e-4 * static_cast<double>(elements) : 0.5;
          result.push_back({.scene = scene,
                            .triangles = 100,
                            .device = "software",
                            .discretize = discretize,
                            .level = level,
                            .resolution = resolution,
                            .elements = elements,
                            .shots = 100,
                            .seconds = {draw + 0.2, draw + 0.1, draw}});
        }
        elements *= 4;
      }
    }
  return result;
}

std::string paperPage(const std::filesystem::path& folder) {
  nlohmann::ordered_json result = cli::paperJson(paperRuns());
  for (const auto& [figure, panel] : {std::pair{2, "a"}, {4, "f-1"}, {0, "plant"}}) {
    const std::string file = std::string(panel) + ".png";
    radiosity::writePng(folder / file, {1, 1, {glm::dvec3(0.5)}});
    result["figures"].push_back(
        {{"figure", figure}, {"panel", panel}, {"file", file}, {"caption", "A </script> pixel"}});
  }
  result["phantoms"] = {{{"scene", "simple"},
                         {"index_maps", "shared"},
                         {"offsets", 13},
                         {"words", 961},
                         {"spare_texels", 5},
                         {"alignment_gaps", 6}}};
  return cli::paperPage(result, folder);
}

/// Rays are faster from 1000 triangles on.
reference::BenchReport benchReport() {
  using reference::timingOf;
  reference::BenchReport report;
  for (const std::size_t triangles : {std::size_t{100}, std::size_t{10000}})
    for (const auto& [what, seconds] : {std::pair{"hemicube", 0.0025},
                                        {"embree", triangles == 100 ? 0.025 : 0.00025},
                                        {"opengl-plain", 0.00625},
                                        {"opengl", 0.0125},
                                        {"floor", 0.001}})
      report.runs.push_back({"room", triangles, 384, 512, 1, what, timingOf({seconds})});
  report.cores = reference::CoreGains{2, 1.94, 1.8, 0.97, 0.9};
  report.walls = {{32, timingOf({0.003}), timingOf({0.002})}};
  for (const char* scene : {"room", "box"})
    report.growth.push_back(
        {scene,
         512,
         {{16, 1000, timingOf({1e-3}), timingOf({1e-4})}, {64, 16000, timingOf({1e-3}), timingOf({1e-3})}}});
  report.parts = {
      {.elements = 9, .resolution = 128, .shots = 300, .hemicubes = 12, .spreading = 4, .besideOfTotal = 0.25}};
  report.memory = reference::SolutionMemory{61, 25, 1 << 20};
  report.errors = {{"room", 256, 0.0123, 0.1, 0.25}};
  return report;
}

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path folder = arguments[1];
  std::ofstream(folder / "paper.html", std::ios::binary) << paperPage(folder);
  std::ofstream(folder / "bench.html", std::ios::binary)
      << cli::completePage(cli::benchPageText, cli::toJson(benchReport()));
}
