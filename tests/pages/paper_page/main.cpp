/// Writes a page of `hemitex paper` with invented data, for paper_page_check.cmake, because the real runs take minutes.
/// The time of meshing is proportional to the number of elements, that of textures is constant, and pictures have one
/// pixel. Usage:
///
///     hemitex_paper_page DIR
#include <fstream>

#include "cli/paper/page.h"
#include "cli/paper/report.h"
#include "radiosity/scene/image.h"

using namespace hemitex;

namespace {

std::vector<reference::PaperRun> runs() {
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

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path folder = arguments[1];
  nlohmann::ordered_json result = cli::paperJson(runs());
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
  std::ofstream(folder / "report.html", std::ios::binary) << cli::paperPage(result, folder);
}
