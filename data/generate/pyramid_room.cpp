/// A closed room with a pyramid. The camera stands outside and looks through the front wall, whose back pictures leave
/// out.
#include "data/generate/models.h"
#include "data/generate/shapes.h"

namespace hemitex::data {

Model pyramidRoom() {
  Model model;
  model.name = "pyramid-room";
  model.about = {
      "A closed room with a pyramid: surfaces that are not rectangles. Lengths, in metres, are made up. The pyramid's",
      "sides rise from a hole in the floor; it has no base. The light is cut out of the ceiling.",
      "Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The materials of the room with a pyramid, made up: plain walls, two coloured ones and a warm light.",
      "Kd is diffuse reflectance, Ke emitted radiosity, both linear sRGB. Written by hemitex_data.",
  };
  model.materials = {{"plain", {0.72, 0.72, 0.7}},
                     {"green", {0.16, 0.48, 0.12}},
                     {"violet", {0.42, 0.16, 0.5}},
                     {"sandstone", {0.78, 0.6, 0.34}},
                     {"light", glm::dvec3{0.5}, {20, 18, 15}}};

  const Polygon ceiling = rectangle(-2.5, 2.5, -2.5, 2.5, 3.2);
  const Polygon light = rectangle(-2, -1, -1, 0, 3.2);
  // A square of 2 m by 2 m, rotated by the angle of the triangle 7, 24, 25.
  const Polygon base{{{-0.68, 0, 1.24}, {1.24, 0, 0.68}, {0.68, 0, -1.24}, {-1.24, 0, -0.68}}};
  const glm::dvec3 apex{0, 1.7, 0};
  Group pyramid{"pyramid", "sandstone", {}};
  for (std::size_t i = 0; i < 4; ++i) pyramid.polygons.push_back({{base.corners[i], base.corners[(i + 1) % 4], apex}});

  model.groups = walls(ceiling, {"plain", "violet", "plain", "green"});
  model.groups.push_back({"floor", "plain", frame(atHeight(ceiling, 0), base)});
  model.groups.push_back({"ceiling", "plain", frame(reversed(ceiling), reversed(light))});
  model.groups.push_back(pyramid);
  model.groups.push_back({"light", "light", {reversed(light)}});
  model.view = {{0, 1.6, 7}, {0, 1.6, 0}, {0, 1, 0}, 39};
  return model;
}

}  // namespace hemitex::data
