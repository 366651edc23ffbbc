/// A model: polygons in named groups, their materials and a view, and the text of the files that hold them.
///
/// Numbers are written in the shortest decimal form that reads back to the same binary64, so a file's bytes depend on
/// nothing but the model.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace hemitex::data {

struct Material {
  std::string name;
  glm::dvec3 reflectance{0.0};
  glm::dvec3 emission{0.0};  ///< emitted radiosity
};

/// A polygon, counter-clockwise as seen from the side that reflects.
struct Polygon {
  std::vector<glm::dvec3> corners;
  std::vector<glm::dvec2> texcoords = {};  ///< one a corner, or none
};

/// What becomes a surface, or several where its parts lie in different planes.
struct Group {
  std::string name;
  std::string material;
  std::vector<Polygon> polygons;
};

/// The camera of pictures.
struct View {
  glm::dvec3 eye{0.0};
  glm::dvec3 lookAt{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov = 0;  ///< vertical, in degrees
};

struct Model {
  std::string name;                ///< of the files, without ending
  std::vector<std::string> about;  ///< lines: what it is and where its numbers come from
  std::vector<std::string> aboutMaterials;
  std::vector<Material> materials;
  std::vector<Group> groups;
  View view;
};

struct File {
  std::string name;
  std::string text;
};

/// NAME.obj, NAME.mtl and NAME.view.json. Equal positions share a vertex.
std::vector<File> files(const Model& model);

}  // namespace hemitex::data
