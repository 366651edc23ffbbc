/// The pages of `hemitex paper` and `hemitex bench` without their minutes of work, for made_up_pages_check.cmake.
///   hemitex_made_up_pages DIR
#include <fstream>

#include "cli/report/bench_report.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "cli/report/paper_report.h"
#include "radiosity/images/image.h"
#include "reference/measurement/bench/render_times.h"
#include "reference/measurement/paper/runs.h"

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

std::vector<reference::BenchRun> benchRuns() {
  std::vector<reference::BenchRun> runs;
  for (const int resolution : {128, 512})
    for (const auto& [what, seconds] : {std::pair{"hemicube", 0.0025},
                                        {"embree", 0.025},
                                        {"opengl-plain", 0.00625},
                                        {"opengl", 0.0125},
                                        {"floor", 0.001}})
      runs.push_back({"room", 1000, 384, resolution, 1, what, reference::timingOf({seconds})});
  return runs;
}

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path folder = arguments[1];
  std::ofstream(folder / "paper.html", std::ios::binary) << paperPage(folder);
  std::ofstream(folder / "bench.html", std::ios::binary)
      << cli::completePage(cli::benchPageText, cli::benchJson(benchRuns()));
}
