/// Reads a solved folder for pictures. scene.obj holds triangles object by object, with coordinates in radiosity
/// textures. solution.json says which surface they belong to, and holds their places and grids.
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
  /// The folder of a scene file; nothing if it has no solution.json. Gives the scene its solved surfaces and charts.
  /// Throws InputError if that file does not belong to the scene.
  static std::optional<SolvedFolder> around(const std::filesystem::path& sceneFile, radiosity::Scene& scene);

  /// The settings that give the solved grids.
  radiosity::DiscretizationSettings grids(const radiosity::Scene& scene) const;
  /// The scene with the reflectances and the lights that it was solved with. Throws InputError for what the folder does
  /// not hold: maps, spectra, and images by symmetry.
  radiosity::Scene unlit(radiosity::Scene scene) const;
  /// The radiosity of each element in W/m^2, from the EXR textures. Throws InputError if a texture is too small.
  std::vector<glm::dvec3> radiosity(const radiosity::Discretization& discretization) const;
  /// Replaces the display textures of the scene by its radiosity times `exposure`.
  void expose(radiosity::Scene& scene, double exposure) const;
  /// The exposure of the display textures.
  double exposure() const { return exposure_; }
  /// The irradiance of its sky in W/m^2; 0 without one.
  glm::dvec3 sky() const { return lights_.outside.sky; }

 private:
  /// The place of a surface in its texture (see radiosity::TexturePlace), and its grid; all in texels.
  struct Place {
    std::string texture;
    int width = 0, height = 0;
    int column = 0, row = 0;
    int columns = 0, rows = 0;
    glm::dvec3 reflectance{0.0}, emission{0.0};  ///< means
    bool isCurved = false;
  };

  std::filesystem::path folder_;
  std::vector<Place> places_;  ///< one per surface of the scene
  radiosity::DiscretizationSettings settings_;
  double exposure_ = 1;
  radiosity::Scene lights_;  ///< its suns, lamps, sky and unit
  std::string lacks_;        ///< what a gather needs and the folder does not hold
};

}  // namespace hemitex::cli
