// docs/files.md: each row of its tables, by a small file: its light in closed form, or its message.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "radiosity/discretization/discretize.h"
#include "radiosity/images/image.h"
#include "radiosity/projection/projection_kinds.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/base64.h"
#include "tests/support/compressed_meshes.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using nlohmann::json;
using std::numbers::pi;
using tests::base64;
using tests::writeAll;

namespace {

/// What a file must give: the light of a closed cube of area 6, per band, or words of a warning or an error.
struct Expected {
  std::optional<glm::dvec3> light = {};
  std::vector<std::string> warnings = {};  ///< parts of warnings; without any, none of `left out`
  std::string error = {};
};
Expected lit(const glm::dvec3& light, std::vector<std::string> warnings = {}) { return {light, std::move(warnings)}; }
Expected lit(double light, std::vector<std::string> warnings = {}) {
  return lit(glm::dvec3(light), std::move(warnings));
}
Expected refused(const std::string& error) { return {{}, {}, error}; }

/// Files by name; the scene is the first.
struct Files {
  std::vector<std::pair<std::string, std::string>> files;
  Expected expected;
  std::string cellReflectance = {};
};

// ---- The closed cube ------------------------------------------------------------------------------------------------

const std::vector<glm::vec3> cubeCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                         {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
/// A place whose coordinates 24 bits round by .25.
const glm::vec3 farAway(500000.1F, 5000000.5F, 0);
const Expected rounded{{}, {"rounded to binary32 by up to 0.25"}};
/// Seen from inside.
const std::vector<std::vector<int>> cubeFaces{{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                              {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};

std::string cubeVertices(const std::string& tail = "") {
  std::string text;
  for (const glm::vec3& corner : cubeCorners)
    text +=
        "v " + std::to_string(corner.x) + " " + std::to_string(corner.y) + " " + std::to_string(corner.z) + tail + "\n";
  return text + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
}

std::string cubePolygons(const std::string& keyword = "f") {
  std::string text;
  for (const std::vector<int>& face : cubeFaces) {
    text += keyword;
    for (std::size_t k = 0; k < 4; ++k) text += " " + std::to_string(face[k] + 1) + "/" + std::to_string(k + 1);
    text += "\n";
  }
  return text;
}

/// A cube in OBJ, with the text of its material.
Files withMtl(const std::string& mtl, const Expected& expected) {
  return {{{"a.obj", "mtllib m.mtl\n" + cubeVertices() + "usemtl m\n" + cubePolygons()},
           {"m.mtl", "newmtl m\nKe 1 1 1\n" + mtl}},
          expected};
}

const std::string halfMtl = "newmtl m\nKe 1 1 1\nKd .5 .5 .5\n";

/// A cube in OBJ of reflectance 0.5, with more lines.
Files withObj(const std::string& lines, const Expected& expected) {
  return {
      {{"a.obj", "mtllib m.mtl\n" + lines + "\n" + cubeVertices() + "usemtl m\n" + cubePolygons()}, {"m.mtl", halfMtl}},
      expected};
}
Files asObj(const std::string& text, const Expected& expected) {
  return {{{"a.obj", text}, {"m.mtl", halfMtl}}, expected};
}

// ---- glTF -----------------------------------------------------------------------------------------------------------

template <typename Value>
std::string bytesOf(const std::vector<Value>& values) {
  std::string bytes(values.size() * sizeof(Value), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A cube of two triangles per side: each side has corners of its own, with texture coordinates 0 to 1.
struct Gltf {
  json text = json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "materials": [{"emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1]}}],
    "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}]})");
  std::string bytes;

  Gltf() {
    std::vector<float> positions, texcoords, normals(72, 0.0F);
    std::vector<std::uint16_t> indices;
    for (const std::vector<int>& face : cubeFaces) {
      const auto first = static_cast<std::uint16_t>(positions.size() / 3);
      for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec3& corner = cubeCorners[static_cast<std::size_t>(face[k])];
        positions.insert(positions.end(), {corner.x, corner.y, corner.z});
        texcoords.insert(texcoords.end(), {k == 1 || k == 2 ? 1.0F : 0.0F, k < 2 ? 1.0F : 0.0F});
      }
      for (const int corner : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(first + corner));
    }
    primitive()["attributes"]["POSITION"] = add(positions, 5126, "VEC3");
    primitive()["attributes"]["TEXCOORD_0"] = add(texcoords, 5126, "VEC2");
    primitive()["indices"] = add(indices, 5123, "SCALAR");
  }
  json& primitive() { return text["meshes"][0]["primitives"][0]; }
  json& material() { return text["materials"][0]; }
  json& colour() { return material()["pbrMetallicRoughness"]; }

  int view(const std::string& content) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    text["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
    bytes += content;
    return static_cast<int>(text["bufferViews"].size()) - 1;
  }
  template <typename Value>
  int add(const std::vector<Value>& values, int type, const std::string& shape) {
    const std::size_t width = shape == "SCALAR" ? 1 : static_cast<std::size_t>(shape.back() - '0');
    text["accessors"].push_back({{"bufferView", view(bytesOf(values))},
                                 {"componentType", type},
                                 {"count", values.size() / width},
                                 {"type", shape}});
    return static_cast<int>(text["accessors"].size()) - 1;
  }
  /// A vec3 per vertex, the same for all.
  int addForAll(const std::vector<float>& value) {
    std::vector<float> values;
    for (int v = 0; v < 24; ++v) values.insert(values.end(), value.begin(), value.end());
    return add(values, 5126, "VEC" + std::to_string(value.size()));
  }
  std::string file() const {
    json whole = text;
    whole["buffers"][0] = {{"byteLength", bytes.size()},
                           {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
    return whole.dump();
  }
};

using Edit = std::function<void(Gltf&)>;
Files gltf(const Edit& edit, const Expected& expected,
           const std::vector<std::pair<std::string, std::string>>& others = {}) {
  Gltf cube;
  edit(cube);
  Files files{{{"a.gltf", cube.file()}}, expected};
  files.files.insert(files.files.end(), others.begin(), others.end());
  return files;
}
Files extension(const std::string& name, const Expected& expected, bool isRequired = false) {
  return gltf(
      [&](Gltf& cube) {
        cube.text["extensionsUsed"] = {name};
        if (isRequired) cube.text["extensionsRequired"] = {name};
      },
      expected);
}

/// The image of the tests: black on the left, linear 0.5 on the right (see `half`). With texture coordinates 0 to 1 its
/// mean is a quarter.
std::string pngOf(std::vector<glm::dvec3> pixels) {
  const TemporaryFolder folder;
  writePng(folder.path / "t.png", {static_cast<int>(pixels.size()), 1, std::move(pixels)});
  return raster::readFile(folder.path / "t.png");
}
const glm::dvec3 half(decodeSrgb(188 / 255.0));
std::string halfBlack() { return pngOf({glm::dvec3(0), half}); }
/// The same as WebP without loss, by cwebp.
std::string webpOfHalfBlack() {
  constexpr std::array<unsigned char, 40> bytes{0x52, 0x49, 0x46, 0x46, 0x20, 0x00, 0x00, 0x00, 0x57, 0x45,
                                                0x42, 0x50, 0x56, 0x50, 0x38, 0x4c, 0x13, 0x00, 0x00, 0x00,
                                                0x2f, 0x01, 0x00, 0x00, 0x00, 0x0f, 0x30, 0xbc, 0xc3, 0x3b,
                                                0xbc, 0xf3, 0x1f, 0x78, 0xa8, 0x40, 0x44, 0xff, 0x03, 0x00};
  return {bytes.begin(), bytes.end()};
}
double ofMean(double mean) { return 1 / (1 - mean); }

/// The texture as base colour, with a sampler.
Files textured(const std::function<void(Gltf&)>& edit, double mean) {
  return gltf(
      [&](Gltf& cube) {
        cube.text["images"] = {{{"uri", "t.png"}}};
        cube.text["textures"] = {{{"source", 0}, {"sampler", 0}}};
        cube.text["samplers"] = {json::object()};
        cube.colour() = {{"baseColorTexture", {{"index", 0}}}};
        edit(cube);
      },
      lit(ofMean(mean)), {{"t.png", halfBlack()}});
}
Files wrapped(int mode, double mean) {
  return textured(
      [&](Gltf& cube) {
        std::vector<float> texcoords;
        for (int side = 0; side < 6; ++side) texcoords.insert(texcoords.end(), {0, 1, 4, 1, 4, 0, 0, 0});
        cube.primitive()["attributes"]["TEXCOORD_0"] = cube.add(texcoords, 5126, "VEC2");
        cube.text["samplers"] = {{{"wrapS", mode}, {"wrapT", mode}}};
      },
      mean);
}

// ---- STL, PLY, VTK, View3D ------------------------------------------------------------------------------------------

std::string stlFacets(const std::string& normal = "0 0 0", const std::string& endLoop = "endloop") {
  std::string text;
  for (const std::vector<int>& face : cubeFaces)
    for (const std::size_t second : {1U, 2U}) {
      text += "facet normal " + normal + "\nouter loop\n";
      for (const std::size_t k : {std::size_t{0}, std::size_t{second}, std::size_t{second + 1}}) {
        const glm::vec3& corner = cubeCorners[static_cast<std::size_t>(face[k])];
        text += "vertex " + std::to_string(corner.x) + " " + std::to_string(corner.y) + " " + std::to_string(corner.z) +
                "\n";
      }
      text += endLoop + "\nendfacet\n";
    }
  return text;
}
Files stl(const std::string& bytes, const Expected& expected) { return {{{"a.stl", bytes}}, expected}; }

std::string binaryStl(float normal = 0, std::uint16_t attribute = 0, const std::string& start = "solid ",
                      const glm::vec3& shift = {}) {
  std::string bytes = start + std::string(80 - start.size(), ' ') + bytesOf(std::vector<std::uint32_t>{12});
  for (const std::vector<int>& face : cubeFaces)
    for (const std::size_t second : {1U, 2U}) {
      bytes += bytesOf(std::vector<float>(3, normal));
      for (const std::size_t k : {std::size_t{0}, std::size_t{second}, std::size_t{second + 1}})
        bytes += bytesOf(std::vector<glm::vec3>{cubeCorners[static_cast<std::size_t>(face[k])] + shift});
      bytes += bytesOf(std::vector<std::uint16_t>{attribute});
    }
  return bytes;
}

std::string plyVertices(const std::string& properties = "", const std::string& tail = "", const std::string& head = "",
                        const glm::vec3& shift = {}) {
  std::string text = "ply\nformat ascii 1.0\n" + head +
                     "element vertex 8\nproperty float x\nproperty float y\nproperty float z\n" + properties;
  std::string vertices;
  for (const glm::vec3& unmoved : cubeCorners) {
    const glm::vec3 corner = unmoved + shift;
    vertices +=
        std::to_string(corner.x) + " " + std::to_string(corner.y) + " " + std::to_string(corner.z) + tail + "\n";
  }
  return text + "FACES" + "end_header\n" + vertices;
}
Files ply(std::string vertices, const Expected& expected, const std::string& list = "vertex_indices",
          const std::string& properties = "", const std::string& tail = "") {
  vertices.replace(vertices.find("FACES"), 5, "element face 6\nproperty list uchar int " + list + "\n" + properties);
  for (const std::vector<int>& face : cubeFaces) {
    vertices += "4";
    for (const int corner : face) vertices += " " + std::to_string(corner);
    vertices += tail + "\n";
  }
  return {{{"a.ply", vertices}}, expected};
}
/// A strip per side.
std::string strips(const std::string& separator, const std::string& begin) {
  std::string text;
  for (const std::vector<int>& face : cubeFaces)
    text += (text.empty() ? "" : separator) + begin + std::to_string(face[0]) + " " + std::to_string(face[1]) + " " +
            std::to_string(face[3]) + " " + std::to_string(face[2]);
  return text;
}

std::string vtkPoints(const std::string& dataSet) {
  std::string text = "# vtk DataFile Version 3.0\na\nASCII\nDATASET " + dataSet + "\nPOINTS 8 double\n";
  for (const glm::vec3& corner : cubeCorners)
    text += std::to_string(corner.x) + " " + std::to_string(corner.y) + " " + std::to_string(corner.z) + "\n";
  return text;
}
std::string vtkCells(const std::string& keyword) {
  std::string text = keyword + " 6 30\n";
  for (const std::vector<int>& face : cubeFaces) {
    text += "4";
    for (const int corner : face) text += " " + std::to_string(corner);
    text += "\n";
  }
  return text;
}
Files vtk(const std::string& text, const Expected& expected, const std::string& cellReflectance = "") {
  return {{{"a.vtk", text}}, expected, cellReflectance};
}

std::string vs3(const std::string& base = "0", const std::string& combined = "0", const std::string& emittance = "0.5",
                const std::string& format = "F 3\n") {
  std::string text = "T a\n" + format;
  int number = 0;
  for (const glm::vec3& corner : cubeCorners)
    text += "V " + std::to_string(++number) + " " + std::to_string(corner.x) + " " + std::to_string(corner.y) + " " +
            std::to_string(corner.z) + "\n";
  number = 0;
  for (const std::vector<int>& face : cubeFaces) {
    text += "S " + std::to_string(++number);
    for (const int corner : face) text += " " + std::to_string(corner + 1);
    text += " " + base + " " + combined + " " + emittance + " s" + std::to_string(number) + "\n";
  }
  return text + "End Of Data\n";
}
Files view3d(const std::string& text, const Expected& expected) { return {{{"a.vs3", text}}, expected}; }

// ---- The rows -------------------------------------------------------------------------------------------------------

using Rows = std::map<std::string, std::vector<Files>>;

Rows objRows() {
  const std::string left = "left out: `";
  const std::string head = "mtllib m.mtl\nusemtl m\n";
  std::string joined = "mtllib m.mtl\n# C:\\models\\\nusemtl \\\r\n m\n" + cubeVertices();
  for (const std::vector<int>& face : cubeFaces)
    joined += "f " + std::to_string(face[0] + 1) + "\\\n" + std::to_string(face[1] + 1) + " \\  \n" +
              std::to_string(face[2] + 1) + " \\\r" + std::to_string(face[3] + 1) + "\n";
  joined += "f 1 2 3\\";
  joined.replace(joined.rfind("f 1 2 3"), 7, "g a");
  const std::string grey = " 0.5 0.25 1";
  return {
      {"`v x y z`", {withObj("", lit(2))}},
      {"`v x y z w`",
       {asObj(head + cubeVertices(" 1") + cubePolygons(), lit(2)),
        asObj(head + cubeVertices(" 2") + cubePolygons(), lit(2, {"fourth coordinate"}))}},
      {"`v x y z r g b`",
       {asObj(head + cubeVertices(grey) + cubePolygons(),
              lit(1.0 / (1.0 - 0.5 * decodeSrgb(glm::dvec3(0.5, 0.25, 1))))),
        asObj(cubeVertices(" 0.5 0.5 0.5 1") + cubePolygons(), lit(glm::dvec3(0)))}},
      {"`vt`", {withObj("vt 0.5", lit(2))}},
      {"`vn`", {withObj("vn 0 0 1", lit(2))}},
      {"`f`",
       {asObj(head + cubeVertices() + "f 1 2 4 3\nf -4 -2 -1 -3\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n",
              lit(2))}},
      {"`fo`", {asObj(head + cubeVertices() + cubePolygons("fo"), lit(2))}},
      {"`\\` at the end of a line", {asObj(joined, lit(2))}},
      {"`#`", {withObj("# v 1 2 3", lit(2))}},
      {"`# units: mm`, `# File units = meters` and others before the first `v`", {withObj("# units: mm", lit(2))}},
      {"`g`, `o`", {withObj("o a\ng b c", lit(2))}},
      {"`usemtl`", {withObj("usemtl other", lit(2))}},
      {"`mtllib`", {withObj("mtllib m.mtl m.mtl\nmtllib \"m.mtl\"\nmtllib .\\M.MTL\nmtllib C:\\x\\m.mtl", lit(2))}},
      {"`s`, `mg`", {withObj("s 1\nmg 1 2", lit(2))}},
      {"`bevel`, `lod`, `c_interp`, `d_interp`, `shadow_obj`, `trace_obj`",
       {withObj("bevel on\nlod 1\nc_interp on\nd_interp on\nshadow_obj a\ntrace_obj a", lit(2))}},
      {"`p`, `l`", {withObj("p 1\nl 1 2", lit(2, {left + "l` (line 3), `p` (line 2)"}))}},
      {"`curv`, `curv2`, `surf`",
       {withObj("cstype bezier\ndeg 3\ncurv 0 1 1 2\nparm u 0 1\nend\ncurv2 1 2\nsurf 0 1 0 1 1 2",
                lit(2, {"`surf`"}))}},
      {"`call`, `csh`, `maplib`, `usemap`",
       {withObj("call a.obj\ncsh ls\nmaplib a\nusemap b", lit(2, {"`call`", "`csh`", "`maplib`", "`usemap`"}))}},
      {"other words", {withObj("vertex 1 2 3", lit(2, {"`vertex`"}))}},
  };
}

Rows mtlRows() {
  const auto mapped = [](const std::string& lines, const Expected& expected) {
    Files files = withMtl(lines, expected);
    files.files.emplace_back("t.png", halfBlack());
    return files;
  };
  const double quarter = 0.5 * half.x;
  Files clamped = mapped("map_Kd -clamp on t.png\n", lit(ofMean(0.875 * half.x)));
  Files beyond = clamped;
  std::string& text = clamped.files[0].second;
  for (const auto& [from, to] : {std::pair("vt 1 0\n", "vt 4 0\n"), std::pair("vt 1 1\n", "vt 4 1\n")})
    text.replace(text.find(from), 7, to);
  Files withAlpha = withMtl("map_Kd t.png\n", lit(ofMean(0), {"the alpha of its map_Kd is left out"}));
  const std::vector<unsigned char> clear = encodePng({1, 1, {0, 0, 0}, {}, {true}}, "t.png");
  withAlpha.files.emplace_back("t.png", std::string(clear.begin(), clear.end()));
  Files absolute = mapped("map_Kd \"C:\\images\\T.png\"\n", lit(ofMean(quarter)));
  return {
      {"`newmtl`", {withMtl("KD .5 .5 .5\n", lit(2))}},
      {"`Kd r g b`", {withMtl("Kd .5 .25 .75\n", lit({2, 4 / 3., 4})), withMtl("Kd .5\n", lit(2))}},
      {"`Kd spectral`", {withMtl("Kd spectral a.rfl\n", refused("a.rfl"))}},
      {"`Kd xyz`", {withMtl("Kd xyz .5 .5 .5\n", refused("m.mtl:3: 'xyz' is not a number"))}},
      {"`Ke r g b`", {withMtl("Kd .5 .5 .5\nKe 2 1 .5\n", lit({4, 2, 1}))}},
      {"`map_Kd`",
       {mapped("map_Kd t.png\n", lit(ofMean(quarter * 0.9999))),
        mapped("Kd .5 .5 .5\nmap_Kd ./t.png\n", lit(ofMean(quarter / 2))), absolute}},
      {"`Kd 0 0 0` with `map_Kd`",
       {mapped("Kd 0 0 0\nmap_Kd t.png\n", lit(ofMean(quarter), {"Kd 0 0 0 with a map_Kd"}))}},
      {"`Ke 0 0 0` with `map_Ke`",
       {mapped("Kd .5 .5 .5\nKe 0 0 0\nmap_Ke t.png\n", lit(2 * quarter, {"Ke 0 0 0 with a map_Ke"}))}},
      {"`map_Ke`", {mapped("Kd .5 .5 .5\nmap_Ke t.png\n", lit(2 * quarter))}},
      {"`-s u v`, `-o u v`",
       {mapped("map_Kd -s .5 1 t.png\n", lit(1)), mapped("map_Kd -s .5 1 1 -o .5 0 0 t.png\n", lit(ofMean(half.x)))}},
      {"`-clamp on`", {clamped}},
      {"`-mm`, `-t`, `-imfchan`, `-cc`, `-colorspace`",
       {mapped("map_Kd -mm 0 2 t.png\n", lit(ofMean(quarter), {"-mm"})),
        mapped("map_Kd -t 1 t.png\n", lit(ofMean(quarter), {"-t"})),
        mapped("map_Kd -imfchan r t.png\n", lit(ofMean(quarter), {"-imfchan"})),
        mapped("map_Kd -colorspace linear t.png\n", lit(ofMean(quarter), {"-colorspace"}))}},
      {"`-blendu`, `-blendv`, `-boost`, `-texres`, `-bm`",
       {mapped("map_Kd -blendu on -blendv off -boost 2 -texres 4 -bm 1 t.png\n", lit(ofMean(quarter)))}},
      {"`d`, `Tr`",
       {withMtl("Kd .5 .5 .5\nd .5\n", lit(2, {"d below 1"})),
        withMtl("Kd .5 .5 .5\nTr .5\n", lit(2, {"Tr above 0"}))}},
      {"`map_d`",
       {mapped("Kd .5 .5 .5\nmap_d -s 0 1 -o .75 0 t.png\n", lit(2)),
        withMtl("Kd .5 .5 .5\nmap_d t.png\n", lit(2, {"t.png", "without the image of its map_d it is opaque"}))}},
      {"alpha of `map_Kd`", {withAlpha}},
      {"`decal`", {withMtl("Kd .5 .5 .5\ndecal t.png\n", lit(2, {"decal is left out"}))}},
      {"`Ka`, `Ks`, `Ns`, `Ni`, `Tf`, `illum`, `refl`, `bump`, `disp` and their maps",
       {withMtl("Kd .5 .5 .5\nKa 1 1 1\nKs 1 1 1\nNs 9\nNi 1.5\nillum 4\nbump t.png\nmap_Ks t.png\n", lit(2))}},
  };
}

Rows gltfRows() {
  const auto nothing = [](Gltf&) {};
  const double black = 0, quarter = 0.5 * half.x;
  const auto coloured = [](const std::vector<float>& colour, bool isStated) {
    return [colour, isStated](Gltf& cube) {
      cube.primitive()["attributes"]["COLOR_0"] = cube.addForAll(colour);
      if (!isStated) cube.colour().clear();
    };
  };
  const auto codes = [](const auto full, int type) {
    return [full, type](Gltf& cube) {
      std::vector<std::remove_const_t<decltype(full)>> values;
      for (int v = 0; v < 24; ++v) values.insert(values.end(), {full, 0, full, full});
      cube.primitive()["attributes"]["COLOR_0"] = cube.add(values, type, "VEC4");
      cube.text["accessors"].back()["normalized"] = true;
    };
  };
  const auto atDistance = [](Gltf& cube) {
    std::vector<float> positions;
    for (const std::vector<int>& face : cubeFaces)
      for (const int corner : face) {
        const glm::vec3 p = cubeCorners[static_cast<std::size_t>(corner)] + farAway;
        positions.insert(positions.end(), {p.x, p.y, p.z});
      }
    cube.primitive()["attributes"]["POSITION"] = cube.add(positions, 5126, "VEC3");
  };
  const auto sparse = [](Gltf& cube) {  // moves a corner into place that the view has elsewhere
    std::vector<float> positions;
    for (const std::vector<int>& face : cubeFaces)
      for (const int corner : face) {
        const glm::vec3& p = cubeCorners[static_cast<std::size_t>(corner)];
        positions.insert(positions.end(), {p.x, p.y, p.z});
      }
    positions[0] = 9;
    const int accessor = cube.add(positions, 5126, "VEC3");
    const int places = cube.view(bytesOf(std::vector<std::uint16_t>{0})),
              values = cube.view(bytesOf(std::vector<float>{0, 0, 0}));
    cube.text["accessors"].back()["sparse"] = {{"count", 1},
                                               {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                                               {"values", {{"bufferView", values}}}};
    cube.primitive()["attributes"]["POSITION"] = accessor;
  };
  const auto morphed = [](bool ofNode) {  // the cube stretched, and squeezed again by the node
    return [ofNode](Gltf& cube) {
      std::vector<float> moved;
      for (const std::vector<int>& face : cubeFaces)
        for (const int corner : face)
          moved.insert(moved.end(), {cubeCorners[static_cast<std::size_t>(corner)].x, 0, 0});
      cube.primitive()["targets"] = {{{"POSITION", cube.add(moved, 5126, "VEC3")}}};
      cube.text["meshes"][0]["weights"] = {ofNode ? 7.0 : 1.0};
      if (ofNode) cube.text["nodes"][0]["weights"] = {1.0};
      cube.text["nodes"][0]["scale"] = {0.5, 1, 1};
    };
  };
  const auto strip = [](int mode) {
    return [mode](Gltf& cube) {
      json primitive = cube.primitive();
      json all = json::array();
      for (int side = 0; side < 6; ++side) {
        const auto first = static_cast<std::uint16_t>(4 * side);
        const auto at = [&](int k) { return static_cast<std::uint16_t>(first + k); };
        primitive["indices"] = cube.add(mode == 5 ? std::vector<std::uint16_t>{at(0), at(1), at(3), at(2)}
                                                  : std::vector<std::uint16_t>{at(0), at(1), at(2), at(3)},
                                        5123, "SCALAR");
        primitive["mode"] = mode;
        all.push_back(primitive);
      }
      cube.text["meshes"][0]["primitives"] = all;
    };
  };
  const auto quantized = [](Gltf& cube) {
    std::vector<std::uint8_t> positions;
    for (const std::vector<int>& face : cubeFaces)
      for (const int corner : face) {
        const glm::vec3 p = 255.0F * cubeCorners[static_cast<std::size_t>(corner)];
        for (const float x : {p.x, p.y, p.z, 0.0F}) positions.push_back(static_cast<std::uint8_t>(x));
      }
    const int accessor = cube.add(positions, 5121, "VEC4");
    json& added = cube.text["accessors"].back();
    added["type"] = "VEC3";
    added["normalized"] = true;
    cube.text["bufferViews"].back()["byteStride"] = 4;
    cube.primitive()["attributes"]["POSITION"] = accessor;
    cube.text["extensionsRequired"] = cube.text["extensionsUsed"] = {"KHR_mesh_quantization"};
  };
  const auto glossy = [](Gltf& cube) {
    cube.material()["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {{"diffuseFactor", {0.25, 0.5, 0.75, 1}}};
    cube.text["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
  };
  const auto transformed = [](const json& transform) {
    return [transform](Gltf& cube) {
      cube.colour()["baseColorTexture"]["extensions"]["KHR_texture_transform"] = transform;
      cube.text["extensionsRequired"] = cube.text["extensionsUsed"] = {"KHR_texture_transform"};
    };
  };
  const auto instanced = [](Gltf& cube) {  // each side of a half cube
    cube.text["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", cube.add(std::vector<float>{1, 2, 3}, 5126, "VEC3")},
        {"ROTATION", cube.add(std::vector<float>{0, 0, 1, 0}, 5126, "VEC4")},
        {"SCALE", cube.add(std::vector<float>{1, 1, 1}, 5126, "VEC3")}};
    cube.text["extensionsRequired"] = cube.text["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  };
  const auto lamp = [](json light, const Expected& expected) {
    return gltf(
        [&](Gltf& cube) {
          cube.text["extensionsUsed"] = {"KHR_lights_punctual"};
          cube.text["extensions"]["KHR_lights_punctual"]["lights"] = {light};
          cube.text["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
        },
        expected);
  };
  const auto webp = [](const std::string& uri, bool hasOther) {
    return [uri, hasOther](Gltf& cube) {
      cube.text["images"] = {{{"uri", uri}}, {{"uri", "t.png"}}};
      if (uri.empty())
        cube.text["images"][0] = {{"bufferView", cube.view(webpOfHalfBlack())}, {"mimeType", "image/webp"}};
      cube.text["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
      if (hasOther) cube.text["textures"][0]["source"] = 1;
      cube.colour() = {{"baseColorTexture", {{"index", 0}}}};
      cube.text["extensionsUsed"] = {"EXT_texture_webp"};
      if (!hasOther) cube.text["extensionsRequired"] = {"EXT_texture_webp"};
    };
  };
  // The right half of the texture, so that lost coordinates are seen.
  const auto compressed = [](const auto& compress) {
    return textured(
        [compress](Gltf& cube) {
          std::vector<float> texcoords;
          for (int side = 0; side < 6; ++side) texcoords.insert(texcoords.end(), {0.5, 1, 1, 1, 1, 0, 0.5, 0});
          const int values = cube.add(texcoords, 5126, "VEC2");
          cube.text["accessors"].erase(cube.primitive()["attributes"]["TEXCOORD_0"].get<std::size_t>());
          cube.primitive()["attributes"]["TEXCOORD_0"] = values - 1;
          cube.primitive()["indices"] = values - 2;
          compress(cube.text, cube.bytes);
        },
        half.x);
  };
  const auto draco = [&](bool inSequence) {
    return compressed([=](json& text, std::string& bytes) { tests::compressByDraco(text, bytes, inSequence); });
  };
  const auto meshopt = [&](tests::MeshoptMode mode) {
    return compressed([=](json& text, std::string& bytes) { tests::compressByMeshopt(text, bytes, mode); });
  };
  return {
      {"`.gltf`, `.glb`, files beside it, `data:` URIs", {gltf(nothing, lit(2)), textured(nothing, quarter)}},
      {"`scene`, `nodes`, `matrix`, `translation`, `rotation`, `scale`",
       {gltf(
           [](Gltf& cube) {
             cube.text["nodes"][0]["translation"] = {1, 2, 3};
           },
           lit(2))}},
      {"modes 4, 5, 6", {gltf(strip(5), lit(2)), gltf(strip(6), lit(2))}},
      {"modes 0 to 3",
       {gltf(
           [](Gltf& cube) {
             json lines = cube.primitive();
             lines["mode"] = 1;
             cube.text["meshes"][0]["primitives"].push_back(lines);
           },
           lit(2, {"points and lines are left out"}))}},
      {"`POSITION`, `NORMAL`",
       {gltf(
           [](Gltf& cube) {
             cube.primitive()["attributes"]["NORMAL"] = cube.addForAll({0, 0, 1});
           },
           lit(2))}},
      {"`TEXCOORD_n`",
       {textured(
           [](Gltf& cube) {
             cube.primitive()["attributes"]["TEXCOORD_1"] = cube.addForAll({0.75F, 0.5F});
             cube.colour()["baseColorTexture"]["texCoord"] = 1;
           },
           half.x)}},
      {"`COLOR_0`",
       {gltf(coloured({0.5F, 0.25F, 0.75F}, true), lit({4 / 3., 8 / 7., 1.6})),
        gltf(coloured({0.5F, 0.25F, 0.75F, 0.5F}, false), lit({2, 4 / 3., 4})),
        gltf(codes(std::uint8_t{255}, 5121), lit({2, 1, 2})), gltf(codes(std::uint16_t{65535}, 5123), lit({2, 1, 2}))}},
      {"`COLOR_1` and others, `TANGENT`",
       {gltf(
           [](Gltf& cube) {
             cube.primitive()["attributes"]["COLOR_1"] = cube.addForAll({0, 0, 1});
           },
           lit(2))}},
      {"sparse accessors", {gltf(sparse, lit(2))}},
      {"coordinates far from the origin", {gltf(atDistance, rounded)}},
      {"`targets` with `weights`", {gltf(morphed(false), lit(2)), gltf(morphed(true), lit(2))}},
      {"`baseColorFactor`, `baseColorTexture`",
       {gltf(nothing, lit(2)), gltf([](Gltf& cube) { cube.colour().clear(); }, lit(5, {"states no colour"}))}},
      {"`emissiveFactor`, `emissiveTexture`",
       {textured(
            [](Gltf& cube) {
              cube.colour()["baseColorFactor"] = {0, 0, 0, 1};
            },
            black),
        gltf(
            [](Gltf& cube) {
              cube.text["images"] = {{{"uri", "t.png"}}};
              cube.text["textures"] = {{{"source", 0}}};
              cube.material()["emissiveTexture"] = {{"index", 0}};
            },
            lit(2 * quarter), {{"t.png", halfBlack()}}),
        gltf(
            [](Gltf& cube) {
              cube.text["images"] = {{{"uri", "t.png"}}};
              cube.text["textures"] = {{{"source", 0}}};
              cube.material()["emissiveTexture"] = {{"index", 0}};
              cube.material()["emissiveFactor"] = {0, 0, 0};
            },
            lit(0, {"emissiveFactor 0"}), {{"t.png", halfBlack()}})}},
      {"`wrapS`, `wrapT`", {wrapped(10497, quarter), wrapped(33648, quarter), wrapped(33071, 0.875 * half.x)}},
      {"`alphaMode`: `BLEND`", {gltf([](Gltf& cube) { cube.material()["alphaMode"] = "BLEND"; }, lit(2, {"BLEND"}))}},
      {"`alphaMode`: `MASK`, `alphaCutoff`",
       {gltf(
           [](Gltf& cube) {
             cube.material()["alphaMode"] = "MASK";
             cube.material()["alphaCutoff"] = 0.25;
             cube.colour()["baseColorFactor"][3] = 0.3;
           },
           lit(2))}},
      {"`metallicFactor`, `normalTexture`, `occlusionTexture`, `doubleSided`",
       {gltf(
           [](Gltf& cube) {
             cube.colour()["metallicFactor"] = 1;
             cube.material()["doubleSided"] = true;
           },
           lit(2))}},
      {"`cameras`",
       {gltf(
           [](Gltf& cube) {
             cube.text["cameras"] =
                 json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
             cube.text["nodes"][0]["camera"] = 0;
           },
           lit(2))}},
      {"`skins`, `animations`",
       {gltf(
           [](Gltf& cube) {
             cube.text["animations"] = json::parse(R"([{"samplers": [{"input": 0, "output": 0}],
               "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])");
           },
           lit(2, {"skins and animations"}))}},
      {"`extras`",
       {gltf(
           [](Gltf& cube) {
             cube.material()["extras"] = {{"a", 1}};
           },
           lit(2))}},
      {"`KHR_materials_emissive_strength`",
       {gltf(
           [](Gltf& cube) {
             cube.material()["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 4}};
           },
           lit(8))}},
      {"`KHR_materials_pbrSpecularGlossiness`", {gltf(glossy, lit({4 / 3., 2, 4}))}},
      {"`KHR_materials_unlit`", {extension("KHR_materials_unlit", lit(2, {"unlit"}), true)}},
      {"`KHR_materials_transmission`",
       {gltf(
           [](Gltf& cube) {
             cube.material()["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
           },
           lit(2, {"KHR_materials_transmission"}))}},
      {"`KHR_texture_transform`",
       {textured(transformed({{"scale", {0.5, 1}}}), black),
        textured(transformed({{"scale", {0.5, 1}}, {"offset", {0.5, 0}}}), half.x),
        // Turned by a quarter, the coordinate that grew downwards grows to the right.
        textured(transformed({{"rotation", std::acos(0.0)}, {"scale", {1, 0.5}}, {"offset", {0.5, 0}}}), half.x)}},
      {"`KHR_mesh_quantization`", {gltf(quantized, lit(2))}},
      {"`EXT_mesh_gpu_instancing`", {gltf(instanced, lit(2))}},
      {"`KHR_draco_mesh_compression`", {draco(true), draco(false)}},
      {"`EXT_meshopt_compression`",
       {meshopt(tests::MeshoptMode::Exact), meshopt(tests::MeshoptMode::Rotated),
        meshopt(tests::MeshoptMode::Exponents)}},
      {"`EXT_texture_webp`",
       {gltf(webp("t.webp", false), lit(ofMean(quarter)), {{"t.webp", webpOfHalfBlack()}}),
        gltf(webp("data:image/webp;base64," + base64(webpOfHalfBlack()), false), lit(ofMean(quarter))),
        gltf(webp("", false), lit(ofMean(quarter))),
        gltf(webp("t.webp", true), lit(ofMean(quarter)), {{"t.webp", "none"}, {"t.png", halfBlack()}})}},
      {"`KHR_lights_punctual`: `point`, `spot`",
       {lamp({{"type", "point"}, {"intensity", 683}, {"color", {1, 0.5, 0}}},
             lit(2.0 + 4 * pi / 3 * glm::dvec3(1, 0.5, 0))),
        lamp({{"type", "spot"}, {"intensity", 683 * 2}, {"spot", {{"outerConeAngle", pi / 2}}}},
             lit(2 + 2 * 2 * pi / 3 / 3)),
        lamp({{"type", "point"}, {"intensity", -1}}, refused("intensity")),
        lamp({{"type", "tube"}}, refused("unknown type `tube`"))}},
      {"`KHR_lights_punctual`: `directional`", {lamp({{"type", "directional"}, {"intensity", 683}}, lit(2))}},
      {"`range` of a light", {lamp({{"type", "point"}, {"intensity", 0}, {"range", 3}}, lit(2, {"range"}))}},
      {"other extensions that the file requires",
       {extension("KHR_materials_volume", refused("KHR_materials_volume"), true),
        extension("KHR_materials_ior", refused("KHR_materials_ior"), true),
        extension("KHR_texture_basisu", refused("KHR_texture_basisu"), true)}},
      {"other extensions that the file uses",
       {extension("KHR_materials_clearcoat", lit(2, {"left out: KHR_materials_clearcoat"})),
        extension("FB_ngon_encoding", lit(2, {"left out: FB_ngon_encoding"}))}},
  };
}

Rows stlRows() {
  const std::string solid = "solid a\n" + stlFacets(), end = "endsolid a\n";
  std::string flat = solid + end;
  std::replace(flat.begin(), flat.end(), '\n', '\r');
  std::string upper = solid + end;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](char c) { return static_cast<char>(std::toupper(c)); });
  const Expected dark = lit(0), trailing = lit(0, {"bytes behind the last triangle are left out"});
  const float nan = std::nanf("");
  return {
      {"text, binary",
       {stl(solid + end, dark), stl(flat, dark), stl(upper, dark), stl(stlFacets() + "endsolid\n", dark),
        stl(binaryStl(), dark), stl(binaryStl(0, 0, "binary"), dark), stl("\xEF\xBB\xBF" + solid + end, dark),
        stl("PK\x03\x04", refused("is no STL file")),
        stl(binaryStl().substr(0, 300), refused("announces 12 triangles"))}},
      {"`solid NAME`", {stl("solid\n" + stlFacets() + "endsolid\n", dark), stl(solid + end + "solid\nendsolid", dark)}},
      {"`facet normal`",
       {stl("solid\n" + stlFacets("-nan(ind) nan 1e999") + end, dark),
        stl("solid\n" + stlFacets("inf -inf x") + end, dark), stl(binaryStl(nan), dark),
        stl(binaryStl(HUGE_VALF), dark)}},
      {"`outer loop`, `endloop`, `end loop`", {stl("solid\n" + stlFacets("0 0 0", "end loop") + end, dark)}},
      {"`endsolid`, `end solid`, `ENDSOLID`",
       {stl(solid + "end solid a\n", dark), stl(solid + "ENDSOLID", dark), stl(solid + "End Solid", dark),
        stl(solid, refused("without endsolid"))}},
      {"blank lines before `solid`", {stl("\n \r\n\t" + solid + end, dark)}},
      {"bytes behind the last triangle",
       {stl(binaryStl() + "\n", trailing), stl(binaryStl() + std::string(99, '\0'), trailing)}},
      {"coordinates far from the origin", {stl(binaryStl(0, 0, "solid ", farAway), rounded)}},
      {"colours in attributes",
       {stl(binaryStl(0, 0x8001), lit(0, {"colours of facets"})),
        stl(binaryStl(0, 0, "COLOR=abcd"), lit(0, {"colours of facets"}))}},
  };
}

Rows plyRows() {
  const std::string colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const auto stripped = [](const std::string& list) {
    std::string text = plyVertices();
    text.replace(text.find("FACES"), 5, "element tristrips 1\nproperty list int int vertex_indices\n");
    return Files{{{"a.ply", text + list}}, lit(0)};
  };
  std::string cloud = plyVertices();
  cloud.replace(cloud.find("FACES"), 5, "");
  std::string big = "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 0\r\nend_header\r\n";
  return {
      {"`ascii`, `binary_little_endian`, `binary_big_endian`", {ply(plyVertices(), lit(0))}},
      {"`vertex` with `x`, `y`, `z`", {ply(plyVertices(), lit(0))}},
      {"coordinates far from the origin", {ply(plyVertices("", "", "", farAway), rounded)}},
      {"`red`, `green`, `blue` of vertices", {ply(plyVertices(colours, " 188 0 188"), lit(0))}},
      {"`face` with `vertex_indices` or `vertex_index`", {ply(plyVertices(), lit(0), "vertex_index")}},
      {"`tristrips`",
       {stripped("29 " + strips(" -1 ", "")), stripped("31 -1 " + strips(" -1 ", "") + " -1"),
        stripped("29 0 1 2 3 -1 4 6 5 7 -1 0 4 1 5 -1 2 3 6 7 -1 0 2 4 6 -1 1 5 3 7")}},
      {"`red`, `green`, `blue` of faces",
       {ply(plyVertices(), lit(0, {"colours of faces"}), "vertex_indices", colours, " 1 2 3")}},
      {"a file without faces", {Files{{{"a.ply", cloud}}, refused("cloud of points")}}},
      {"`comment TextureFile`", {ply(plyVertices("", "", "comment TextureFile a.png\n"), lit(0, {"TextureFile"}))}},
      {"other elements and properties", {ply(plyVertices("property float nx\n", " 1"), lit(0))}},
  };
}

Rows vtkRows() {
  const std::string polygons = vtkPoints("POLYDATA") + vtkCells("POLYGONS");
  const std::string grid = vtkPoints("UNSTRUCTURED_GRID") + vtkCells("CELLS") + "CELL_TYPES 6\n";
  const std::string data = "CELL_DATA 6\nSCALARS r double\nLOOKUP_TABLE default\n.5 .5 .5 .5 .5 .5\n";
  const auto xml = [](const std::string& cells) {
    std::string points;
    for (const glm::vec3& corner : cubeCorners)
      points += std::to_string(corner.x) + " " + std::to_string(corner.y) + " " + std::to_string(corner.z) + " ";
    const std::string array = "<DataArray type=\"Int32\" Name=\"", format = "\" format=\"ascii\">";
    std::string list, offsets;
    for (const std::vector<int>& face : cubeFaces)
      for (const std::size_t k : {0U, 1U, 3U, 2U}) list += std::to_string(face[k]) + " ";
    for (int side = 1; side <= 6; ++side) offsets += std::to_string(4 * side) + " ";
    return Files{{{"a.vtp",
                   "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"8\" "
                   "NumberOf" +
                       cells +
                       "=\"6\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
                       "format=\"ascii\">" +
                       points + "</DataArray></Points><" + cells + ">" + array + "connectivity" + format + list +
                       "</DataArray>" + array + "offsets" + format + offsets + "</DataArray></" + cells +
                       "></Piece></PolyData></VTKFile>"}},
                 lit(0)};
  };
  return {
      {"`.vtk`: `POLYDATA`, `UNSTRUCTURED_GRID`", {vtk(polygons, lit(0)), vtk(grid + "9 9 9 9 9 9\n", lit(0))}},
      {"`.vtp`, `.vtu`", {xml("Strips")}},
      {"`POLYGONS`, cells of triangles, quads, pixels and polygons", {vtk(grid + "7 9 7 9 7 9\n", lit(0))}},
      {"`TRIANGLE_STRIPS`, cells of strips",
       {vtk(vtkPoints("POLYDATA") + "TRIANGLE_STRIPS 6 30\n" + strips("\n", "4 ") + "\n" + data, lit(0), "r"),
        vtk(vtkPoints("UNSTRUCTURED_GRID") + "CELLS 6 30\n" + strips("\n", "4 ") + "\nCELL_TYPES 6\n6 6 6 6 6 6\n",
            lit(0))}},
      {"points and lines",
       {vtk(vtkPoints("POLYDATA") + "LINES 1 3\n2 0 1\n" + vtkCells("POLYGONS"), lit(0, {"left out"}))}},
      {"volumes, curved cells",
       {vtk(grid + "9 9 9 9 9 10\n", refused("volume cells")), vtk(grid + "9 9 9 9 9 22\n", refused("type 22"))}},
      {"other data sets", {vtk(vtkPoints("STRUCTURED_GRID"), refused("STRUCTURED_GRID"))}},
      {"cell data", {vtk(polygons + data, lit(0), "r")}},
      {"point data", {vtk(polygons + "POINT_DATA 8\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n", lit(0))}},
  };
}

Rows vs3Rows() {
  return {
      {"`V`, `S`", {view3d(vs3(), lit(0))}},
      {"`O`", {view3d("F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\nO 1 1 2 3 0\nE\n", {})}},
      {"the emittance", {view3d(vs3("0", "0", "2"), refused("an emittance is from 0 to 1"))}},
      {"a surface to combine with", {view3d(vs3("0", "1"), lit(0, {"combined"}))}},
      {"a base surface, masks",
       {view3d(vs3("1"), refused("inside of another")), view3d("F 3\nM 1 2\n", refused("masks"))}},
      {"other formats than `3`", {view3d(vs3("0", "0", "1", "F 3a\n"), refused("format 3"))}},
  };
}

// ---- The walk -------------------------------------------------------------------------------------------------------

/// The first column of each table of the page, by heading.
std::map<std::string, std::vector<std::string>> tablesOf(const std::string& page) {
  std::map<std::string, std::vector<std::string>> tables;
  std::string heading, line;
  for (std::istringstream lines(page); std::getline(lines, line);) {
    if (line.starts_with("## ")) heading = line.substr(3);
    if (line.starts_with("| ") && !line.starts_with("| construct"))
      tables[heading].push_back(line.substr(2, line.find(" | ") - 2));
  }
  return tables;
}

/// The mean over area of what elements and lamps emit over what elements absorb; the area must be that of the cube.
glm::dvec3 lightOf(const Scene& scene) {
  const Discretization discretization = discretize(scene, {.texels = 4});
  glm::dvec3 emitted(0), reflected(0);
  double total = 0;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    const double area = discretization.elements[e].area;
    emitted += area * emission(scene, discretization, e);
    reflected += area * reflectance(scene, discretization, e);
    total += area;
  }
  for (const Lamp& lamp : scene.lamps) emitted += fullSolidAngle(lamp.cone) * lamp.intensity;
  CHECK(total == Approx(6));
  return emitted / (total - reflected);
}

bool isNamed(const std::vector<std::string>& warnings, const std::string& part) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& warning) { return warning.find(part) != warning.npos; });
}

void checkFiles(const Files& given) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : given.files) writeAll(folder.path / name, content);
  const std::filesystem::path file = folder.path / given.files.front().first;
  CAPTURE(file.extension(), given.files.front().second.substr(0, 3000));
  SceneSettings settings;
  settings.cellReflectance = given.cellReflectance;
  const Expected& expected = given.expected;
  if (!expected.error.empty()) {
    REQUIRE_THROWS_WITH(loadScene(file, settings), Catch::Contains(expected.error));
    return;
  }
  const Scene scene = loadScene(file, settings);
  std::string all;
  for (const std::string& warning : scene.warnings) all += warning + "\n";
  CAPTURE(all);
  if (expected.light) {
    const glm::dvec3 light = lightOf(scene);
    for (int band = 0; band < 3; ++band)
      CHECK(light[band] == Approx((*expected.light)[band]).epsilon(1e-3).margin(1e-12));
  }
  for (const std::string& warning : expected.warnings) CHECK(isNamed(scene.warnings, warning));
  if (expected.warnings.empty()) CHECK_FALSE(isNamed(scene.warnings, "left out"));
}

}  // namespace

TEST_CASE("loadScene does with each construct of a format what docs/files.md says", "[files]") {
  const std::map<std::string, Rows> formats{{"OBJ", objRows()}, {"MTL", mtlRows()}, {"glTF", gltfRows()},
                                            {"STL", stlRows()}, {"PLY", plyRows()}, {"VTK", vtkRows()},
                                            {"vs3", vs3Rows()}};
  const auto tables = tablesOf(raster::readFile(std::filesystem::path(HEMITEX_DOCS) / "files.md"));
  CHECK(tables.size() == formats.size());
  for (const auto& [format, rows] : formats) {
    REQUIRE(tables.contains(format));
    const std::vector<std::string>& constructs = tables.at(format);
    for (const std::string& construct : constructs) {
      CAPTURE(format, construct);
      CHECK(rows.contains(construct));
    }
    for (const auto& [construct, files] : rows) {
      CAPTURE(format, construct);
      CHECK(std::count(constructs.begin(), constructs.end(), construct) == 1);
      for (const Files& some : files) checkFiles(some);
    }
  }
}
