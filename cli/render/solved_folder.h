/// A solved folder, read back for pictures. Its scene.obj is a scene like any other, but its charts lie inside
/// radiosity textures; solution.json says where, and which grid each surface had, so that pictures show what was
/// solved.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

class SolvedFolder {
 public:
  /// The folder that the file of a scene lies in; nothing where no solution.json stands beside it. Throws InputError
  /// where that file is not what `solve` wrote for the scene.
  static std::optional<SolvedFolder> around(const std::filesystem::path& sceneFile, const radiosity::Scene& scene);

  /// Undoes the way into the textures: the charts are those that were solved.
  void restoreCharts(radiosity::Scene& scene) const;
  /// What makes the grids that were solved, once the charts are restored.
  radiosity::DiscretizationSettings grids(const radiosity::Scene& scene) const;
  /// The radiosity of every element, from the EXR textures.
  std::vector<glm::dvec3> radiosity(const radiosity::Discretization& discretization) const;
  /// Replaces what the scene displays by its radiosity times `exposure`.
  void expose(radiosity::Scene& scene, double exposure) const;
  /// The exposure of what it displays.
  double exposure() const { return exposure_; }

 private:
  /// Where a surface lies in its texture (see radiosity::TexturePlace), and its grid.
  struct Place {
    std::string texture;
    int width = 0, height = 0;
    int column = 0, row = 0;
    int columns = 0, rows = 0;
  };

  std::filesystem::path folder_;
  std::vector<Place> places_;  ///< one a surface of the scene
  radiosity::DiscretizationSettings settings_;
  double exposure_ = 1;
};

}  // namespace hemitex::cli
