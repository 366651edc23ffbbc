/// The text of an OBJ file of quads and boxes, in any order and place.
#pragma once

#include <array>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "radiosity/scene/load_scene.h"
#include "tests/support/temporary_folder.h"

namespace hemitex::tests {

struct BoxText {
  /// Faces with a name and a material, as the file lists them.
  struct Part {
    std::string name, material;
    std::vector<std::array<glm::dvec3, 4>> quads = {};
  };
  std::vector<Part> parts;

  void begin(const std::string& name, const std::string& material = "grey") { parts.push_back({name, material}); }

  void addQuad(const std::array<glm::dvec3, 4>& corners) { parts.back().quads.push_back(corners); }

  /// The sides of a box that face outwards, or inwards; the bottom last.
  void addBox(const glm::dvec3& low, const glm::dvec3& high, bool isInward, std::size_t sides = 6) {
    const auto at = [&](int i) {
      return glm::dvec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    constexpr std::array<std::array<int, 4>, 6> faces{
        {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}}};
    for (std::size_t side = 0; side < sides; ++side) {
      const auto& [a, b, c, d] = faces[side];
      addQuad(isInward ? std::array{at(d), at(c), at(b), at(a)} : std::array{at(a), at(b), at(c), at(d)});
    }
  }

  /// The scene of the file. `materials` are the lines of the MTL file.
  radiosity::Scene load(
      const radiosity::SceneSettings& settings = {},
      const std::string& materials = "newmtl grey\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n") const {
    const TemporaryFolder folder;
    std::ofstream(folder.path / "scene.mtl") << materials;
    std::ofstream file(folder.path / "scene.obj");
    file.precision(17);
    file << "mtllib scene.mtl\n";
    for (const Part& part : parts) {
      file << "o " << part.name << "\nusemtl " << part.material << "\n";
      for (const std::array<glm::dvec3, 4>& quad : part.quads) {
        for (const glm::dvec3& p : quad) file << "v " << p.x << ' ' << p.y << ' ' << p.z << "\n";
        file << "f -4 -3 -2 -1\n";
      }
    }
    file.close();
    return radiosity::loadScene(folder.path / "scene.obj", settings);
  }
};

}  // namespace hemitex::tests
