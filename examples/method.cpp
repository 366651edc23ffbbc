/// The method of Nielsen and Christensen, "Fast Texture Based Form Factor Calculations for Radiosity using Graphics
/// Hardware" (2002), in one file: it lights the Cornell box and draws a picture of it.
///
///     method FOLDER    writes scene.obj, radiosity.csv and picture.ppm into the folder
///
/// Read it from top to bottom; each section is a step of the method. Only one thing comes from elsewhere: a renderer,
/// which draws triangles into item buffers (raster/plain/rules.h, 340 lines to read next). It stands for the graphics
/// hardware of the paper. Nothing here is for speed but that form factors are kept, where the paper draws them again.
/// `hemitex solve` does the same for any scene, a thousand times faster: with the same patches its radiosity is equal.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "raster/interface/item_buffer_renderer.h"
#include "raster/plain/plain_renderer.h"

namespace {

using glm::dvec2, glm::dvec3;
using hemitex::raster::ItemId;
namespace raster = hemitex::raster;

// ---------- 1. The scene: rectangles ---------------------------------------------------------------------------------

/// A rectangle: the points corner + s u + t v with s and t in [0, 1]. It is lit on the side that u x v points to.
struct Surface {
  std::string name;
  dvec3 corner, u, v;
  dvec3 reflectance;    // of red, green and blue light
  dvec3 emission{0.0};  // emitted radiosity in W/m^2
};

dvec3 pointOf(const Surface& surface, const dvec2& texcoord) {
  return surface.corner + texcoord.x * surface.u + texcoord.y * surface.v;
}
dvec2 texcoordOf(const Surface& surface, const dvec3& point) {
  const dvec3 offset = point - surface.corner;
  return {glm::dot(offset, surface.u) / glm::dot(surface.u, surface.u),
          glm::dot(offset, surface.v) / glm::dot(surface.v, surface.v)};
}
dvec3 normalOf(const Surface& surface) { return glm::normalize(glm::cross(surface.u, surface.v)); }
double areaOf(const Surface& surface) { return glm::length(glm::cross(surface.u, surface.v)); }

/// A box on the floor without its bottom: edges a and b from a corner, both horizontal.
void addBlock(std::vector<Surface>& scene, const std::string& name, dvec3 corner, dvec3 a, dvec3 b, double height) {
  const dvec3 up(0, height, 0), white(0.74, 0.74, 0.75);
  scene.push_back({name + "-top", corner + up, a, b, white});
  scene.push_back({name + "-side-1", corner, a, up, white});
  scene.push_back({name + "-side-2", corner + b, up, a, white});
  scene.push_back({name + "-side-3", corner, up, b, white});
  scene.push_back({name + "-side-4", corner + a, b, up, white});
}

/// The size of the room, which has a corner at the origin. Positions are drawn from its middle, where single precision
/// is finest.
const dvec3 room(555, 549, 559);

/// The Cornell box in millimetres, open at the front. Positions are those measured at Cornell University, rounded so
/// that every face is a rectangle. The light is a rectangle in a hole of the ceiling.
std::vector<Surface> cornellBox() {
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const dvec3 white(0.74, 0.74, 0.75), red(0.45, 0.036, 0.012), green(0.12, 0.38, 0.024);
  const double width = room.x, height = room.y, depth = room.z;
  std::vector<Surface> scene{
      {"floor", {0, 0, 0}, depth * z, width * x, white},
      {"ceiling-left", {343, height, 0}, (width - 343) * x, depth * z, white},
      {"ceiling-right", {0, height, 0}, 213.0 * x, depth * z, white},
      {"ceiling-front", {213, height, 0}, 130.0 * x, 227.0 * z, white},
      {"ceiling-back", {213, height, 332}, 130.0 * x, (depth - 332) * z, white},
      {"wall-back", {0, 0, depth}, height * y, width * x, white},
      {"wall-green", {0, 0, 0}, height * y, depth * z, green},
      {"wall-red", {width, 0, 0}, depth * z, height * y, red},
      {"light", {213, height, 227}, 130.0 * x, 105.0 * z, {0.78, 0.78, 0.78}, {20.7, 10.9, 2.8}},
  };
  addBlock(scene, "short-block", {130, 0, 65}, {-48, 0, 160}, {160, 0, 48}, 165);
  addBlock(scene, "tall-block", {423, 0, 247}, {-158, 0, 49}, {49, 0, 158}, 330);
  return scene;
}

// ---------- 2. Elements and patches ----------------------------------------------------------------------------------

// Radiosity is computed per element. Here each surface has 12 x 8 elements, the texels of a texture. A patch is a block
// of 4 x 4 elements: it shoots the light of its elements from its centre.
constexpr int columns = 12, rows = 8, patchSide = 4;
constexpr int texels = columns * rows;
constexpr int patchColumns = columns / patchSide, patchRows = rows / patchSide;
constexpr int patchesOfSurface = patchColumns * patchRows;

std::size_t surfaceOfElement(std::size_t element) { return element / texels; }

double elementArea(const std::vector<Surface>& scene, std::size_t element) {
  return areaOf(scene[surfaceOfElement(element)]) / texels;
}

std::size_t patchOfElement(std::size_t element) {
  const std::size_t column = element % texels % columns, row = element % texels / columns;
  return surfaceOfElement(element) * patchesOfSurface + row / patchSide * patchColumns + column / patchSide;
}

/// The texture coordinates of a patch's centre on its surface.
dvec2 centreOfPatch(std::size_t patch) {
  const std::size_t patchInSurface = patch % patchesOfSurface;
  return {(static_cast<double>(patchInSurface % patchColumns) + 0.5) / patchColumns,
          (static_cast<double>(patchInSurface / patchColumns) + 0.5) / patchRows};
}

// ---------- 3. Item IDs: index map + offset --------------------------------------------------------------------------

// This is the idea of the paper. The hardware draws two large triangles per surface, not its 96 elements. A texture,
// the index map, numbers the texels of a surface from 0. The offset, one colour per surface, is added by the blend
// unit. The sum is the item ID (the paper: form factor index) of the element that a pixel shows:
//
//     item ID = offset of the surface + index of the texel
//
// A blend unit adds each channel of 8 bits by itself and clamps the sum to 255: a carry into the next channel is lost.
// So the low k bits belong to the index and all others to the surface: offset = surface * 2^k. Then offset
// and index have no set bit in common, and there is no carry. k bits hold 2^k indices, from 0 to 2^k - 1. (The paper
// prints t = 2^k - 1 for their number t; its examples use 2^k.) Here 96 of 128 are used. The other 32 of each surface
// are phantoms: numbers that no pixel holds.
constexpr int indexBits = 7;
static_assert(texels <= 1 << indexBits);

/// The element of an item ID, by shifting and masking: the upper bits are the surface, the lower ones the index.
std::size_t elementOf(ItemId id) { return std::size_t{id >> indexBits} * texels + id % (1U << indexBits); }

const std::array<dvec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// What the renderer draws: two triangles per surface, one index map for all, one offset per surface.
raster::DrawList makeDrawList(const std::vector<Surface>& scene) {
  raster::DrawList list;
  list.format = {{8, 8, 8, 8}};
  list.blend = raster::Blend::ClampedAdd;
  raster::IndexMap map{columns, rows, {}};
  for (ItemId index = 0; index < texels; ++index) map.ids.push_back(index);
  list.indexMaps.push_back(map);
  for (std::uint32_t s = 0; s < scene.size(); ++s) {
    for (const dvec2& texcoord : corners) {
      list.positions.push_back(glm::vec3(pointOf(scene[s], texcoord) - room / 2.0));
      list.texcoords.push_back(glm::vec2(texcoord));
    }
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) list.indices.push_back(4 * s + corner);
    // Unlit sides block light and absorb it: they share one item ID.
    list.draws.push_back(
        {.first = 6 * s, .count = 6, .offset = s << indexBits, .back = raster::backId(list.format), .indexMap = 0});
  }
  return list;
}

// ---------- 4. The hemicube ------------------------------------------------------------------------------------------

// The upper half of a cube of side 2 stands over the centre of a patch (Cohen and Greenberg 1985). Its top and its four
// half sides are pictures of all that the patch sees.
constexpr int resolution = 256;

/// A face in the axes of the patch: x and y in its plane, z along its normal. Rows of the picture grow along `up`.
struct HemicubeFace {
  dvec3 right, up, forward;
  bool isSide;
};
const std::array<HemicubeFace, 5> hemicube{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, false},
                                            {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, true},
                                            {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}, true},
                                            {{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}, true},
                                            {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, true}}};

raster::Scissor scissorOf(const HemicubeFace& face) {
  return face.isSide ? raster::Scissor{0, resolution / 2, resolution, resolution / 2}
                     : raster::Scissor{0, 0, resolution, resolution};
}

// A pixel's delta form factor is the share of the patch's light that leaves through it: the integral of cos(theta) / pi
// over its solid angle. Per area of the cube that is 1 / (pi (x^2 + y^2 + 1)^2) on the top and z / (pi (x^2 + z^2 +
// 1)^2) on a side. These functions are the integrals over [0, x] x [0, y] and [0, x] x [0, z].
double topIntegral(double x, double y) {
  const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}
double sideIntegral(double x, double z) {
  const double p = std::sqrt(1 + z * z);
  return (std::atan(x) - std::atan(x / p) / p) / (2 * std::numbers::pi);
}

/// The delta form factor of a pixel, from the integrals at its four corners.
double deltaFormFactor(const HemicubeFace& face, int column, int row) {
  const auto coordinate = [](int border) { return 2.0 * border / resolution - 1; };
  const double x0 = coordinate(column), x1 = coordinate(column + 1), y0 = coordinate(row), y1 = coordinate(row + 1);
  const auto integral = face.isSide ? sideIntegral : topIntegral;
  return (integral(x1, y1) - integral(x0, y1)) - (integral(x1, y0) - integral(x0, y0));
}

// ---------- 5. The view from a patch ---------------------------------------------------------------------------------

/// All that the views of a scene share.
struct World {
  std::vector<Surface> scene;
  raster::ItemBufferRenderer& renderer;
  double extent = glm::length(room);
};

/// The distance from a point to a rectangle.
double distance(const dvec3& point, const Surface& surface) {
  return glm::length(point - pointOf(surface, glm::clamp(texcoordOf(surface, point), 0.0, 1.0)));
}

/// The point of a surface, moved. Rounding to single precision must not put the eye behind its own surface or one that
/// it touches. So it is lifted by a few roundings, and moved towards the centroid of its triangle, one of two.
dvec3 eyeOver(const World& world, const Surface& surface, const dvec2& texcoord) {
  const dvec2 centroid = texcoord.x >= texcoord.y ? dvec2(2, 1) / 3.0 : dvec2(1, 2) / 3.0;
  const dvec3 point = pointOf(surface, texcoord), inward = pointOf(surface, centroid) - point;
  const double move = std::min(0.5, 0x1p-19 * world.extent / glm::length(inward));
  return point + move * inward + 0x1p-21 * world.extent * normalOf(surface);
}

/// The five faces over the centre of a patch.
std::vector<raster::Face> facesOver(const World& world, std::size_t patch) {
  const std::size_t surfaceNumber = patch / patchesOfSurface;
  const Surface& surface = world.scene[surfaceNumber];
  const dvec3 eye = eyeOver(world, surface, centreOfPatch(patch)), z = normalOf(surface);

  // The near plane must clip nothing that the patch sees. A point at distance d has a depth of at least d / sqrt(3) on
  // one of the faces: the corners of the cube are its farthest points.
  double nearest = world.extent;
  for (std::size_t s = 0; s < world.scene.size(); ++s)
    if (s != surfaceNumber) nearest = std::min(nearest, distance(eye, world.scene[s]));
  const double nearDistance = std::clamp(nearest / std::sqrt(3.0), 0x1p-24 * world.extent, world.extent);

  // The axes of the patch: y is the coordinate axis that lies best in its plane, without its part along the normal.
  const dvec3 a = glm::abs(z);
  const dvec3 axis = a.x <= a.y && a.x <= a.z ? dvec3(1, 0, 0) : a.y <= a.z ? dvec3(0, 1, 0) : dvec3(0, 0, 1);
  const dvec3 y = glm::normalize(axis - glm::dot(axis, z) * z), x = glm::cross(y, z);
  const auto toWorld = [&](const dvec3& own) { return glm::vec3(own.x * x + own.y * y + own.z * z); };
  std::vector<raster::Face> faces;
  for (const HemicubeFace& face : hemicube)
    faces.push_back({glm::vec3(eye - room / 2.0), toWorld(face.right), toWorld(face.up), toWorld(face.forward),
                     static_cast<float>(nearDistance), resolution, scissorOf(face)});
  return faces;
}

// ---------- 6. A row of form factors ---------------------------------------------------------------------------------

/// Elements that a patch sees, and the share of its light that arrives at each. Numbers of elements are keys, as in the
/// paper's table, so that phantoms and unseen elements take no memory.
using Row = std::map<std::size_t, double>;

/// Each share is the sum of the delta form factors of the pixels that show the element. It costs almost the same for a
/// hundred elements and for a million: so many pixels are read, whatever they show. What is missing to a sum of 1
/// leaves the scene or meets an unlit side.
Row formFactorRow(const World& world, std::size_t patch) {
  const std::uint32_t surface = static_cast<std::uint32_t>(patch / patchesOfSurface);
  const std::array<std::uint32_t, 2> ownTriangles{2 * surface, 2 * surface + 1};  // a surface does not see itself
  const std::vector<raster::ItemBuffer> buffers = raster::render(world.renderer, facesOver(world, patch), ownTriangles);
  Row row;
  for (std::size_t f = 0; f < buffers.size(); ++f) {
    const raster::Scissor scissor = scissorOf(hemicube[f]);
    for (int i = 0; i < scissor.width * scissor.height; ++i) {
      const ItemId id = buffers[f].ids[static_cast<std::size_t>(i)];
      if (id >> indexBits >= world.scene.size()) continue;  // the background, or an unlit side
      row[elementOf(id)] += deltaFormFactor(hemicube[f], i % scissor.width, scissor.row + i / scissor.width);
    }
  }
  return row;
}

// ---------- 7. Shooting ----------------------------------------------------------------------------------------------

double bandSum(const dvec3& flux) { return flux.x + flux.y + flux.z; }

/// Progressive refinement (Cohen, Chen, Wallace and Greenberg 1988). Returns the radiosity of each element in W/m^2:
/// what it emits and what it reflects of the light that it receives.
std::vector<dvec3> solve(const World& world) {
  const std::size_t elements = world.scene.size() * texels;
  std::vector<dvec3> radiosity(elements), unshot(world.scene.size() * patchesOfSurface);
  double emitted = 0;
  for (std::size_t e = 0; e < elements; ++e) {
    radiosity[e] = world.scene[surfaceOfElement(e)].emission;
    const dvec3 flux = radiosity[e] * elementArea(world.scene, e);  // in W: flux is radiosity times area
    unshot[patchOfElement(e)] += flux;
    emitted += bandSum(flux);
  }
  std::vector<Row> rowOf(unshot.size());  // kept, because most patches shoot several times
  const auto hasLess = [](const dvec3& a, const dvec3& b) { return bandSum(a) < bandSum(b); };
  double remaining = emitted;
  while (remaining > 0.001 * emitted) {
    // The patch with the most unshot flux shoots all of it.
    const auto mostUnshot = std::max_element(unshot.begin(), unshot.end(), hasLess);
    const std::size_t patch = static_cast<std::size_t>(mostUnshot - unshot.begin());
    const dvec3 shot = std::exchange(*mostUnshot, dvec3(0));
    if (rowOf[patch].empty()) rowOf[patch] = formFactorRow(world, patch);
    for (const auto& [e, formFactor] : rowOf[patch]) {
      // An element reflects a part of the flux that arrives. Over its area, it is radiosity; the patch shoots it later.
      const dvec3 reflected = world.scene[surfaceOfElement(e)].reflectance * shot * formFactor;
      radiosity[e] += reflected / elementArea(world.scene, e);
      unshot[patchOfElement(e)] += reflected;
    }
    remaining = 0;
    for (const dvec3& flux : unshot) remaining += bandSum(flux);
  }
  return radiosity;
}

// ---------- 8. The picture, and the files ----------------------------------------------------------------------------

/// The radiosity at a point of a surface: the elements are the texels of a radiosity texture, which is filtered
/// bilinearly between their centres (section 3.3 of the paper).
dvec3 filtered(const std::vector<dvec3>& radiosity, std::size_t surface, const dvec2& texcoord) {
  const dvec2 size(columns, rows), place = glm::clamp(texcoord * size - 0.5, dvec2(0), size - 1.0);
  const dvec2 low = glm::min(glm::floor(place), size - 2.0), t = place - low;
  const auto texel = [&](int right, int up) {
    return radiosity[surface * texels + static_cast<std::size_t>((low.y + up) * columns + low.x + right)];
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), t.x), glm::mix(texel(0, 1), texel(1, 1), t.x), t.y);
}

/// Draws what a camera in front of the open side sees. It is one more face: each pixel of its item buffer names the
/// surface. Where the ray through the pixel meets it, the radiosity texture is read.
void writePicture(const World& world, const std::vector<dvec3>& radiosity, const std::filesystem::path& file) {
  constexpr int size = 512;
  constexpr float zoom = 2.8F;  // 1 / tan of half the field of view
  const dvec3 eye(278, 273, -800);
  const raster::Face camera{glm::vec3(eye - room / 2.0), {-zoom, 0, 0}, {0, zoom, 0}, {0, 0, 1}, 1, size,
                            {0, 0, size, size}};
  const raster::ItemBuffer seen = raster::render(world.renderer, std::span(&camera, 1)).front();
  const auto inView = [](int pixel) { return ((2 * pixel + 1.0) / size - 1) / zoom; };
  const auto lightOf = [&](int column, int row) {
    const std::size_t s = seen.ids[static_cast<std::size_t>(row * size + column)] >> indexBits;
    if (s >= world.scene.size()) return dvec3(0);
    const dvec3 ray(-inView(column), inView(row), 1), normal = normalOf(world.scene[s]);
    const double along = glm::dot(world.scene[s].corner - eye, normal) / glm::dot(ray, normal);
    return filtered(radiosity, s, texcoordOf(world.scene[s], eye + along * ray));
  };
  std::ofstream picture(file, std::ios::binary);
  picture << "P6\n" << size << ' ' << size << "\n255\n";
  for (int row = size - 1; row >= 0; --row)  // row 0 is at y = -w, and this y points up
    for (int column = 0; column < size; ++column) {
      const dvec3 light = 0.8 * lightOf(column, row);
      for (int band = 0; band < 3; ++band)
        picture.put(static_cast<char>(std::lround(255 * std::pow(std::min(light[band], 1.0), 1 / 2.2))));
    }
}

void writeRadiosity(const World& world, const std::vector<dvec3>& radiosity, const std::filesystem::path& file) {
  std::ofstream table(file);
  table.precision(std::numeric_limits<double>::max_digits10);
  table << "surface,column,row,b_r,b_g,b_b\n";
  for (std::size_t e = 0; e < radiosity.size(); ++e)
    table << world.scene[surfaceOfElement(e)].name << ',' << e % texels % columns << ',' << e % texels / columns << ','
          << radiosity[e].x << ',' << radiosity[e].y << ',' << radiosity[e].z << '\n';
}

/// The scene for other programs, such as `hemitex solve`.
void writeScene(const std::vector<Surface>& scene, const std::filesystem::path& folder) {
  std::ofstream obj(folder / "scene.obj"), mtl(folder / "scene.mtl");
  obj << "mtllib scene.mtl\n";
  for (const Surface& surface : scene) {
    for (const dvec2& texcoord : corners) {
      const dvec3 corner = pointOf(surface, texcoord);
      obj << "v " << corner.x << ' ' << corner.y << ' ' << corner.z << '\n';
    }
    obj << "g " << surface.name << "\nusemtl " << surface.name << "\nf -4 -3 -2 -1\n";
    const dvec3 &kd = surface.reflectance, &ke = surface.emission;
    mtl << "newmtl " << surface.name << "\nKd " << kd.x << ' ' << kd.y << ' ' << kd.z << "\nKe " << ke.x << ' ' << ke.y
        << ' ' << ke.z << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: method FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const std::vector<Surface> scene = cornellBox();
  raster::PlainRenderer renderer(makeDrawList(scene));
  const World world{scene, renderer};
  const std::vector<dvec3> radiosity = solve(world);
  writeScene(scene, folder);
  writeRadiosity(world, radiosity, folder / "radiosity.csv");
  writePicture(world, radiosity, folder / "picture.ppm");
}
