/// The simple scene of Nielsen and Christensen 2002. The camera stands outside and looks through the front wall, whose
/// back pictures leave out.
#include "data/generate/models.h"
#include "data/generate/shapes.h"

namespace hemitex::data {

Model paperRoom() {
  Model model;
  model.name = "paper-room";
  model.about = {
      "The scene of figure 2 of K. H. Nielsen and N. J. Christensen, \"Fast Texture-Based Form Factor Calculations for",
      "Radiosity using Graphics Hardware\", journal of graphics tools 6(4), 2002: a closed room, a box and a light.",
      "Each of its 13 quads is a surface. The paper gives counts but no lengths: these, in metres, are made up. The",
      "box floats 0.4 m over the floor, so all its faces are lit; the light hangs 1 cm below the ceiling.",
      "Written by hemitex_data.",
  };
  model.aboutMaterials = {
      "The materials of the paper's room, made up: plain walls, two coloured ones and a warm light.",
      "Kd is diffuse reflectance, Ke emitted radiosity, both linear sRGB. Written by hemitex_data.",
  };
  model.materials = {{"plain", {0.74, 0.73, 0.7}},
                     {"red", {0.62, 0.1, 0.07}},
                     {"blue", {0.1, 0.22, 0.6}},
                     {"wood", {0.7, 0.52, 0.28}},
                     {"light", glm::dvec3{0.5}, {22, 19, 15}}};

  const Polygon ceiling = rectangle(-2, 2, -2, 2, 3);
  model.groups = walls(ceiling, {"plain", "blue", "plain", "red"});
  model.groups.push_back({"floor", "plain", {atHeight(ceiling, 0)}});
  model.groups.push_back({"ceiling", "plain", {reversed(ceiling)}});

  // A box of 1.2 m by 1.2 m, rotated about its middle, (0.3, -0.3), by the angle of the triangle 7, 24, 25.
  const Polygon top{{{-0.108, 1.4, 0.444}, {1.044, 1.4, 0.108}, {0.708, 1.4, -1.044}, {-0.444, 1.4, -0.708}}};
  const std::vector<Polygon> around = sides(top, 0.4);
  model.groups.push_back({"box-bottom", "wood", {reversed(atHeight(top, 0.4))}});
  model.groups.push_back({"box-top", "wood", {top}});
  model.groups.push_back({"box-front", "wood", {around[0]}});
  model.groups.push_back({"box-right", "wood", {around[1]}});
  model.groups.push_back({"box-back", "wood", {around[2]}});
  model.groups.push_back({"box-left", "wood", {around[3]}});

  // Light and ceiling are not coplanar, so that rounding does not decide which is visible. With 3 x 3 or 4 x 4 patches
  // on the ceiling, no patch's centre lies behind the light; a hemicube there would see little except the light's back.
  model.groups.push_back({"light", "light", {reversed(rectangle(-0.45, 0.45, 0.2, 1.1, 2.99))}});
  model.view = {{0, 1.5, 6}, {0, 1.5, 0}, {0, 1, 0}, 41};
  return model;
}

}  // namespace hemitex::data
