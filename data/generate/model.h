/// A model: polygons in named groups, their materials and a view, and the text of their files.
///
/// Numbers have the shortest decimal form that parses to the same double, so that the bytes of a file depend only on
/// the model.
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

/// A polygon, counter-clockwise as seen from its reflecting side.
struct Polygon {
  std::vector<glm::dvec3> corners;
  std::vector<glm::dvec2> texcoords = {};  ///< one per corner, or none
};

/// A group becomes one surface, or several if its parts lie in different planes.
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
  std::string name;                ///< of the files, without extension
  std::vector<std::string> about;  ///< lines about the content and the source of its numbers
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
