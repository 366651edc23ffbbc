/// writeVtu: what it writes, parseVtkXml reads. Cell data in files of VTK.
#include "radiosity/meshes/vtu_file.h"

#include <catch2/catch.hpp>

#include "radiosity/meshes/mesh_formats.h"
#include "raster/base/input_error.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using tests::readAll;

namespace {

/// A triangle, a quad and a pentagon that share points; one point is unused.
PolygonMesh someMesh() {
  PolygonMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1.0 / 3}, {9, 9, 9}, {2, 0.5, -1e-17}},
                   .sections = {{0, ""}},
                   .objects = {{"default"}}};
  const std::filesystem::path file = "hand.vtu";
  for (const std::vector<std::uint32_t>& face :
       std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {0, 1, 2, 3}, {0, 1, 5, 2, 3}})
    addPolygon(mesh, face, {file});
  return mesh;
}

std::vector<std::vector<std::uint32_t>> facesOf(const PolygonMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> faces;
  for (const MeshPolygon& polygon : mesh.polygons) {
    faces.emplace_back();
    for (std::uint32_t c = 0; c < polygon.cornerCount; ++c)
      faces.back().push_back(mesh.corners[polygon.firstCorner + c].position);
  }
  return faces;
}

const std::string legacy =
    "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n"
    "VERTICES 1 2\n1 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\n"
    "POINT_DATA 4\nSCALARS power double 1\nLOOKUP_TABLE default\n9 9 9 9\nNORMALS n float\n"
    "0 0 1 0 0 1 0 0 1 0 0 1\nCELL_DATA 3\nSCALARS other int 2\nLOOKUP_TABLE default\n1 2 3 4 5 6\n"
    "SCALARS power float\nLOOKUP_TABLE default\n7 1 2\nVECTORS colour double\n8 8 8 .1 .2 .3 .4 .5 .6\n"
    "FIELD FieldData 2\nunused 1 3 int\n1 2 3\nheat 1 3 double\n0.5 1.5 2.5\n";

}  // namespace

TEST_CASE("writeVtu writes points, faces and cell data that parseVtkXml reads to the same bits", "[meshes]") {
  const PolygonMesh mesh = someMesh();
  const std::vector<FaceArray> arrays{{"b", 3, {1.0 / 3, 2, 3, 4, 5, 6, 7, 8, 1e300}}, {"error", 1, {-0.5, 0, 1e-300}}};
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "a.vtu";
  writeVtu(file, mesh, arrays);
  const PolygonMesh found = parseVtkXml(readAll(file), file, std::vector<std::string>{"error", "b"});
  CHECK(found.positions == mesh.positions);
  CHECK(facesOf(found) == facesOf(mesh));
  REQUIRE(found.arrays.size() == 2);
  CHECK(found.arrays[0].values == arrays[1].values);
  CHECK(found.arrays[1].values == arrays[0].values);
  CHECK(found.arrays[1].components == 3);
  CHECK(parseVtkXml(readAll(file), file).arrays.empty());
  CHECK_THROWS_WITH(parseVtkXml(readAll(file), file, std::vector<std::string>{"c"}),
                    Catch::Contains("no cell data `c`; there are `b`, `error`"));
}

TEST_CASE("parseVtkXml reads the cell data of faces behind those of points and lines", "[meshes]") {
  const std::string vtp =
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfLines=\"1\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"1\"><CellData><DataArray type=\"Float32\" Name=\"e\" format=\"ascii\">"
      "1 2 3</DataArray></CellData><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 1 0 0 0 1 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">"
      "0 1 2</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>"
      "</PolyData></VTKFile>";
  const PolygonMesh mesh = parseVtkXml(vtp, "a.vtp", std::vector<std::string>{"e"});
  CHECK(mesh.arrays.front().values == std::vector<double>{3});
}

TEST_CASE("parseLegacyVtk finds cell data among those of points, vectors and fields", "[meshes]") {
  const PolygonMesh mesh = parseLegacyVtk(legacy, "a.vtk", std::vector<std::string>{"colour", "heat", "power"});
  REQUIRE(mesh.arrays.size() == 3);
  CHECK(mesh.arrays[0].values == std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6});
  CHECK(mesh.arrays[0].components == 3);
  CHECK(mesh.arrays[1].values == std::vector<double>{1.5, 2.5});
  CHECK(mesh.arrays[2].values == std::vector<double>{1, 2});
  CHECK_THROWS_WITH(parseLegacyVtk(legacy, "a.vtk", std::vector<std::string>{"n"}),
                    Catch::Contains("no cell data `n`"));
  CHECK_THROWS_WITH(parseLegacyVtk(legacy, "a.vtk", std::vector<std::string>{"other"}),
                    Catch::Contains("`other` have 2 components"));
  // A part of a file is refused, until the last number is at least begun.
  const std::size_t last = legacy.rfind(' ') + 1;
  for (std::size_t size = 0; size <= last; size += size < last - 3 ? 3 : 1)
    CHECK_THROWS_AS(parseLegacyVtk(legacy.substr(0, size), "a.vtk", std::vector<std::string>{"heat"}),
                    raster::InputError);
}
