// Formats of plain meshes: the same faces from each of them, and refusals of damaged files.
#include <zlib.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

#include "radiosity/meshes/vtk_arrays.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "tests/support/base64.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::base64;
using tests::writeAll;

namespace {

/// Two triangles and a quad that share vertices.
const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}, {0, 0, 2}, {1, 0, 2}};
const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {2, 3, 0}, {4, 5, 1, 0}};
/// Also with the quad divided, for formats of triangles.
const std::vector<std::vector<std::uint32_t>> triangles{{0, 1, 2}, {2, 3, 0}, {4, 5, 1}, {4, 1, 0}};

template <typename Value>
void append(std::string& bytes, Value value, bool reversed = false) {
  std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
  if (reversed) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

std::string textStl() {
  std::string text = "solid a mesh\n";
  for (const auto& triangle : triangles) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const std::uint32_t p : triangle)
      text += "   vertex " + std::to_string(points[p].x) + " " + std::to_string(points[p].y) + " " +
              std::to_string(points[p].z) + "\n";
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid a mesh\n";
}

std::string binaryStl() {
  std::string bytes(80, ' ');
  bytes.replace(0, 6, "solid ");  // as some programs write, though it is not text
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, 0.0F);
    for (const std::uint32_t p : triangle)
      for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(points[p][axis]));
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

/// PLY with a property, an element and a list that are skipped.
std::string ply(const std::string& format) {
  std::string bytes = "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex 6\nproperty float x\n" +
                      "property float y\nproperty uchar red\nproperty double z\nelement camera 1\nproperty short f\n" +
                      "element face 3\nproperty list uchar float weight\nproperty list uchar int vertex_indices\n" +
                      "end_header\n";
  const bool isText = format == "ascii", reversed = format == "binary_big_endian";
  const auto add = [&](auto value) {
    if (isText)
      bytes += std::to_string(value) + " ";
    else
      append(bytes, value, reversed);
  };
  for (const glm::dvec3& point : points) {
    add(static_cast<float>(point.x));
    add(static_cast<float>(point.y));
    add(std::uint8_t{255});
    add(point.z);
    if (isText) bytes += "\n";
  }
  add(std::int16_t{50});
  for (const auto& face : faces) {
    if (isText) bytes += "\n";
    add(std::uint8_t{2});
    for (int i = 0; i < 2; ++i) add(0.5F);
    add(static_cast<std::uint8_t>(face.size()));
    for (const std::uint32_t p : face) add(static_cast<std::int32_t>(p));
  }
  return bytes;
}

std::string legacyVtk(bool isBinary, bool isVersion5, bool isGrid) {
  std::string bytes = std::string("# vtk DataFile Version ") + (isVersion5 ? "5.1" : "3.0") + "\na title\n" +
                      (isBinary ? "BINARY" : "ASCII") + "\nDATASET " + (isGrid ? "UNSTRUCTURED_GRID" : "POLYDATA") +
                      "\nPOINTS 6 double\n";
  const auto add = [&](auto value) {
    if (isBinary)
      append(bytes, value, true);
    else
      bytes += std::to_string(value) + "\n";
  };
  for (const glm::dvec3& point : points)
    for (int axis = 0; axis < 3; ++axis) add(point[axis]);
  if (isBinary) bytes += "\n";
  const std::string keyword = isGrid ? "CELLS " : "POLYGONS ";
  if (isVersion5) {
    bytes += keyword + "4 10\nOFFSETS vtktypeint64\n";
    for (const int offset : {0, 3, 6, 10}) add(std::int64_t{offset});
    bytes += "\nCONNECTIVITY vtktypeint64\n";
    for (const auto& face : faces)
      for (const std::uint32_t p : face) add(std::int64_t{p});
  } else {
    bytes += keyword + "3 13\n";
    for (const auto& face : faces) {
      add(static_cast<std::int32_t>(face.size()));
      for (const std::uint32_t p : face) add(static_cast<std::int32_t>(p));
    }
  }
  if (isGrid) {
    bytes += "\nCELL_TYPES 3\n";
    for (const int type : {5, 7, 9}) add(std::int32_t{type});
  }
  return bytes + "\nCELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3\n";
}

/// The options of VTK's writers.
struct XmlOptions {
  bool isPolyData, isAppended, isBase64, isCompressed, isWide;
};

/// An array as VTK encodes it: see vtk_arrays.cpp.
std::string encoded(const std::string& bytes, const XmlOptions& options) {
  const auto number = [&](std::string& header, std::uint64_t value) {
    if (options.isWide)
      append(header, value);
    else
      append(header, static_cast<std::uint32_t>(value));
  };
  const auto text = [&](const std::string& raw) { return options.isBase64 ? base64(raw) : raw; };
  std::string header;
  if (!options.isCompressed) {
    number(header, bytes.size());
    return text(header + bytes);
  }
  constexpr std::size_t blockBytes = 40;
  const std::size_t blocks = (bytes.size() + blockBytes - 1) / blockBytes;
  number(header, blocks);
  number(header, blockBytes);
  number(header, bytes.size() % blockBytes);
  std::string packed;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::string block = bytes.substr(b * blockBytes, blockBytes);
    std::string out(200, 0);
    uLongf size = out.size();
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(block.data()), block.size());
    number(header, size);
    packed += out.substr(0, size);
  }
  return text(header) + text(packed);
}

std::string xmlVtk(const XmlOptions& options) {
  std::string appended;
  const auto array = [&](const std::string& attributes, const std::string& bytes) {
    const std::string data = encoded(bytes, options), start = "<DataArray " + attributes;
    if (!options.isAppended) return start + " format=\"binary\">\n  " + data + "\n</DataArray>\n";
    const std::string offset = std::to_string(appended.size());
    appended += data;
    return start + " format=\"appended\" offset=\"" + offset + "\"/>\n";
  };
  std::string coordinates, connectivity, offsets, types;
  for (const glm::dvec3& point : points)
    for (int axis = 0; axis < 3; ++axis) append(coordinates, static_cast<float>(point[axis]));
  std::int64_t end = 0;
  for (const auto& face : faces) {
    for (const std::uint32_t p : face) append(connectivity, std::int64_t{p});
    append(offsets, end += static_cast<std::int64_t>(face.size()));
    append(types, std::uint8_t{7});
  }
  const std::string kind = options.isPolyData ? "PolyData" : "UnstructuredGrid";
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind + "\" version=\"1.0\" byte_order=\"LittleEndian\"" +
      (options.isWide ? " header_type=\"UInt64\"" : "") +
      (options.isCompressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<" + kind +
      ">\n<Piece NumberOfPoints=\"6\" NumberOf" + (options.isPolyData ? "Polys" : "Cells") + "=\"3\">\n<Points>" +
      array("type=\"Float32\" NumberOfComponents=\"3\"", coordinates) + "</Points>\n<" +
      (options.isPolyData ? "Polys" : "Cells") + ">" + array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
      array("type=\"Int64\" Name=\"offsets\"", offsets) +
      (options.isPolyData ? "" : array("type=\"UInt8\" Name=\"types\"", types)) +
      (options.isPolyData ? "</Polys>" : "</Cells>") + "</Piece></" + kind + ">\n";
  if (options.isAppended)
    xml += std::string("<AppendedData encoding=\"") + (options.isBase64 ? "base64" : "raw") + "\">\n_" + appended +
           "\n</AppendedData>";
  return xml + "</VTKFile>\n";
}

const std::string view3d =
    "T a title\nC encl=0 list=2\nF 3\n! # x y z\nV 1 0. 0. 0.\nV 2 1. 0. 0.\nV 3 1 1 0\nV 4 0 1 .5\nV 5 0 0 2\n"
    "V 6 1 0 2 ! the last\nS 1 1 2 3 0 0 0 0.50 floor\nS 2 3 4 1 0 0 1 0.50 floor\nO 3 5 6 2 1\nEnd of data\n";

/// The corners of all triangles, in the order of the file.
std::vector<glm::dvec3> cornersOf(const Scene& scene) {
  std::vector<std::pair<std::uint32_t, std::array<glm::dvec3, 3>>> found;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) found.emplace_back(triangle.polygon, triangle.position);
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<glm::dvec3> corners;
  for (const auto& [polygon, position] : found) corners.insert(corners.end(), position.begin(), position.end());
  return corners;
}

std::vector<glm::dvec3> expectedCorners() {
  std::vector<glm::dvec3> corners;
  for (const auto& triangle : triangles)
    for (const std::uint32_t p : triangle) corners.push_back(points[p]);
  return corners;
}

std::vector<std::pair<std::string, std::string>> allFiles() {
  std::vector<std::pair<std::string, std::string>> files{{"text.stl", textStl()},
                                                         {"binary.STL", binaryStl()},
                                                         {"text.ply", ply("ascii")},
                                                         {"little.ply", ply("binary_little_endian")},
                                                         {"big.ply", ply("binary_big_endian")},
                                                         {"v.vs3", view3d}};
  for (int k = 0; k < 8; ++k)
    files.emplace_back("legacy" + std::to_string(k) + ".vtk", legacyVtk((k & 1) != 0, (k & 2) != 0, (k & 4) != 0));
  for (int k = 0; k < 32; ++k) {
    const XmlOptions options{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0, (k & 16) != 0};
    if (options.isAppended || options.isBase64)
      files.emplace_back("xml" + std::to_string(k) + (options.isPolyData ? ".vtp" : ".vtu"), xmlVtk(options));
  }
  return files;
}

}  // namespace

TEST_CASE("loadScene reads the same faces from each format of meshes", "[meshes]") {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : allFiles()) {
    INFO(name);
    writeAll(folder.path / name, bytes);
    CHECK(isPlainMesh(folder.path / name));
    CHECK(cornersOf(loadScene(folder.path / name)) == expectedCorners());
  }
}

TEST_CASE("loadScene refuses each file of a mesh that was cut off, or reads a part of it", "[meshes]") {
  const TemporaryFolder folder;
  for (const auto& [name, bytes] : allFiles()) {
    const std::filesystem::path file = folder.path / name;
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 200) {
      INFO(name << ": " << size);
      writeAll(file, bytes.substr(0, size));
      try {
        // Behind the geometry, formats have only what is not read; text ends inside of a number, or between faces.
        const std::size_t corners = cornersOf(loadScene(file)).size();
        CHECK(corners <= expectedCorners().size());
      } catch (const raster::InputError& error) {
        CHECK(error.file().starts_with(file.string()));
      }
    }
  }
}

TEST_CASE("loadScene tells what a file of a mesh has that is not read", "[meshes]") {
  const TemporaryFolder folder;
  const std::string vtu = "<VTKFile type=\"UnstructuredGrid\"";
  const std::string vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ";
  for (const auto& [name, text, message] : std::vector<std::tuple<const char*, std::string, const char*>>{
           {"a.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0 0\nendfacet\n", ":4: a facet has three vertices"},
           {"a.stl", "solid a\nvertex 0 0 0\n", ":2: `vertex` is not expected here"},
           {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", ":4: 'x' is not a number"},
           {"a.stl", "solid a\n", "without endsolid"},
           {"a.stl", "PK\x03\x04", "is no STL file"},
           {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "cloud of points"},
           {"a.ply", "ply\nformat text 1.0\n", ":2: 'text' is no format"},
           {"a.ply", "ply\nformat ascii 1.0\nelement vertex x\n", ":3: 'x' is not an integer from 0 to 4294967295"},
           {"a.ply",
            "ply\nformat ascii 1.0\nelement face 1\nproperty list char int vertex_index\nend_header\n3 0 1 2\n",
            ":6: a face names the vertex 0"},
           {"a.vtu", vtu + " compressor=\"vtkLZ4DataCompressor\"><UnstructuredGrid/></VTKFile>",
            "vtkLZ4DataCompressor"},
           {"a.vtu", "<VTKFile type=\"ImageData\"><ImageData/></VTKFile>", "`ImageData`"},
           {"a.vtu", "<html></html>", "no element VTKFile"},
           {"a.vtu", "<VTKFile", "is no XML"},
           {"a.vtk", vtk + "STRUCTURED_GRID\n", "STRUCTURED_GRID is no mesh"},
           {"a.vtk",
            vtk + "UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\n"
                  "CELL_TYPES 1\n10\n",
            "volume cells"},
           {"a.vs3", "F 3a\n", ":1: only the format 3"},
           {"a.vs3", "F 3\nV 2 0 0 0\n", ":2: the number of the vertex should be 1"},
           {"a.vs3", "F 3\nV 1 0 0 0\nS 1 1 1 2 0 0 0 .5 a\n", ":3: '2' is not an integer from 0 to 1"},
           {"a.vs3", view3d.substr(0, view3d.find("O 3")) + "S 3 5 6 2 1 1 0 .5 window\n", "inside of another"},
           {"a.msh", "", "is a Gmsh mesh"},
           {"a.obj", "ply\n", "is a PLY mesh, not OBJ or glTF; give it a name that ends in .ply"}}) {
    INFO(name << ": " << text);
    writeAll(folder.path / name, text);
    CHECK_THROWS_WITH(loadScene(folder.path / name), Catch::Contains(message));
  }
}

TEST_CASE("parseStl warns of normals that contradict the order of vertices", "[meshes]") {
  const TemporaryFolder folder;
  std::string text = textStl();
  text.replace(text.find("normal 0 0 0"), 12, "normal 0 0 -1");
  writeAll(folder.path / "a.stl", text);
  CHECK_THAT(loadScene(folder.path / "a.stl").warnings.front(),
             Catch::StartsWith("1 face winds against its normal (line 8)"));
}

TEST_CASE("fromBase64 undoes the encoding of RFC 4648's examples", "[meshes]") {
  for (const auto& [text, bytes] : {std::pair("", ""),
                                    {"Zg==", "f"},
                                    {"Zm8=", "fo"},
                                    {"Zm9v", "foo"},
                                    {"Zm9vYg==", "foob"},
                                    {"Zm9vYmE=", "fooba"},
                                    {"Zm9vYmFy", "foobar"}})
    CHECK(fromBase64(text, 6) == bytes);
  CHECK(fromBase64("Zm9vYmFy", 2) == "fo");
}

TEST_CASE("loadScene with facets makes a surface of each face, named by its number in the file", "[meshes]") {
  const TemporaryFolder folder;
  // The second face has no area, and the fourth repeats the first.
  writeAll(folder.path / "a.obj",
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
           "g floor\nf 1 2 3\nf 1 2 2\nf 1 3 4\nf 1 2 3\nf 5 6 7 8\n");
  const Scene scene = loadScene(folder.path / "a.obj", {.facets = true});
  CHECK(scene.faces == 5);
  REQUIRE(scene.surfaces.size() == 3);
  for (std::size_t s = 0; s < 3; ++s) {
    CHECK(scene.surfaces[s].family == std::vector{"0", "2", "4"}[s]);
    CHECK(scene.surfaces[s].triangles.front().polygon == 2 * s);
  }
  writeAll(folder.path / "a.vs3", view3d);
  const Scene named = loadScene(folder.path / "a.vs3", {.facets = true});
  CHECK(named.surfaces[1].family == "floor#1");
  CHECK(named.surfaces[2].family == "obstruction#2");
  CHECK_THAT(named.warnings.front(), Catch::StartsWith("1 surface"));
  CHECK_THROWS_AS(loadScene(folder.path / "a.vs3", {.sides = Sides::TwoOfSheets, .facets = true}), raster::InputError);
}
