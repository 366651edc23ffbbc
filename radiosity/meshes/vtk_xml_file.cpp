/// Reads VTK's XML files with an unstructured grid (`.vtu`) or poly data (`.vtp`).
#include <algorithm>
#include <cstring>
#include <limits>

#include "radiosity/meshes/mesh_formats.h"
#include "radiosity/meshes/vtk_arrays.h"
#include "radiosity/meshes/vtk_cells.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {
namespace {

/// A file divided into XML and appended bytes, which need not be XML.
struct Divided {
  std::string xml;
  std::string_view appended = {};
};

Divided divide(std::string_view bytes) {
  const std::size_t tag = bytes.find("<AppendedData");
  const std::size_t end = tag == bytes.npos ? bytes.npos : bytes.find('>', tag);
  if (end == bytes.npos) return {std::string(bytes)};
  const std::size_t data = bytes.find('_', end);
  return {std::string(bytes.substr(0, end + 1)) + "</AppendedData></VTKFile>",
          data == bytes.npos ? std::string_view() : bytes.substr(data + 1)};
}

pugi::xml_node arrayNamed(const pugi::xml_node& parent, const char* name) {
  return parent.find_child_by_attribute("DataArray", "Name", name);
}

/// The pieces are counted before they are read, because several may name one array.
void requireMemoryFor(const auto& pieces, const std::filesystem::path& file) {
  std::uint64_t points = 0, cells = 0;
  for (const pugi::xml_node& piece : pieces) {
    points += piece.attribute("NumberOfPoints").as_uint();
    for (const char* name : {"NumberOfCells", "NumberOfPolys"}) cells += piece.attribute(name).as_uint();
  }
  if (points > std::numeric_limits<std::uint32_t>::max()) fail({file}, "has more than 2^32 points", "divide it");
  constexpr std::uint64_t cellBytes = sizeof(MeshPolygon) + 3 * sizeof(MeshCorner);
  raster::requireMemory(points * sizeof(glm::dvec3) + cells * cellBytes, file.string(),
                        "the mesh of " + std::to_string(points) + " points and " + std::to_string(cells) + " cells",
                        "divide it");
}

/// The cells of a piece; `first` is the number of its first point in the mesh.
class PieceReader {
 public:
  PieceReader(const VtkArrays& arrays, const std::filesystem::path& file, PolygonMesh& mesh, std::uint32_t& leftOut)
      : arrays_(arrays), file_(file), mesh_(mesh), leftOut_(leftOut) {}

  void read(const pugi::xml_node& piece, bool isPolyData) {
    first_ = static_cast<std::uint32_t>(mesh_.positions.size());
    firstPolygon_ = mesh_.polygons.size();
    points_ = count(piece, "NumberOfPoints");
    const std::vector<double> points =
        points_ == 0 ? std::vector<double>()
                     : arrays_.numbers(piece.child("Points").child("DataArray"), std::uint64_t{points_} * 3);
    for (std::size_t p = 0; p < points.size(); p += 3)
      addPosition(mesh_, {points[p], points[p + 1], points[p + 2]}, {file_});
    if (!isPolyData) {
      const std::uint32_t cells = count(piece, "NumberOfCells");
      readCells(piece.child("Cells"), cells, 0,
                cells == 0 ? std::vector<std::uint32_t>()
                           : arrays_.indices(arrayNamed(piece.child("Cells"), "types"), cells, 255));
      return readCellData(piece.child("CellData"), cells);
    }
    const std::uint32_t others = count(piece, "NumberOfVerts") + count(piece, "NumberOfLines"),
                        polygons = count(piece, "NumberOfPolys"), strips = count(piece, "NumberOfStrips");
    leftOut_ += others;
    readCells(piece.child("Polys"), polygons, others, {});
    readCells(piece.child("Strips"), strips, others + polygons, std::vector<std::uint32_t>(strips, vtkStrip));
    readCellData(piece.child("CellData"), others + polygons + strips);
  }

 private:
  static std::uint32_t count(const pugi::xml_node& piece, const char* name) { return piece.attribute(name).as_uint(); }

  /// `first` is the number of the first cell in the cell data. Without types, all cells are polygons.
  void readCells(const pugi::xml_node& cells, std::uint32_t number, std::uint32_t first,
                 const std::vector<std::uint32_t>& types) {
    if (number == 0) return;
    const std::vector<std::uint32_t> ends =
        arrays_.indices(arrayNamed(cells, "offsets"), number, std::numeric_limits<std::uint32_t>::max());
    if (!std::is_sorted(ends.begin(), ends.end())) fail({file_}, "the offsets of cells do not ascend");
    std::vector<std::uint32_t> points;
    if (ends.back() > 0)
      points = arrays_.indices(arrayNamed(cells, "connectivity"), ends.back(), points_ == 0 ? 0 : points_ - 1);
    for (std::uint32_t& point : points) point += first_;
    for (std::uint32_t c = 0, start = 0; c < number; start = ends[c++]) {
      addVtkCell(mesh_, types.empty() ? vtkPolygon : types[c], std::span(points).subspan(start, ends[c] - start),
                 {file_}, leftOut_);
      faces_.resize(mesh_.polygons.size() - firstPolygon_, first + c);
    }
  }

  /// Reads the arrays of the mesh by their names.
  void readCellData(const pugi::xml_node& data, std::uint32_t cells) {
    if (faces_.empty()) return;
    for (FaceArray& array : mesh_.arrays) {
      const pugi::xml_node found = arrayNamed(data, array.name.c_str());
      if (!found) failMissing(array.name, data);
      const int components = found.attribute("NumberOfComponents").as_int(1);
      if (components < 1) fail({file_}, "the cell data `" + array.name + "` have no components");
      addCellValues(array, components, arrays_.numbers(found, std::uint64_t{cells} * static_cast<unsigned>(components)),
                    faces_, {file_});
    }
  }
  [[noreturn]] void failMissing(const std::string& name, const pugi::xml_node& data) const {
    std::string names;
    for (const pugi::xml_node& array : data.children("DataArray"))
      names += (names.empty() ? "`" : ", `") + raster::excerpt(array.attribute("Name").value()) + "`";
    fail({file_}, "has no cell data `" + raster::excerpt(name) + "`",
         names.empty() ? "there are none at all" : "there are " + names);
  }

  const VtkArrays& arrays_;
  const std::filesystem::path& file_;
  PolygonMesh& mesh_;
  std::uint32_t& leftOut_;
  std::uint32_t first_ = 0, points_ = 0;
  std::size_t firstPolygon_ = 0;
  std::vector<std::uint32_t> faces_;  ///< the numbers of the cells that are faces
};

}  // namespace

PolygonMesh parseVtkXml(std::string_view bytes, const std::filesystem::path& file,
                        std::span<const std::string> cellData) {
  const Divided divided = divide(bytes);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(divided.xml.data(), divided.xml.size());
  if (!parsed) fail({file}, "is no XML behind its byte " + std::to_string(parsed.offset), "give the whole file");
  const pugi::xml_node root = document.child("VTKFile");
  if (!root) fail({file}, "has no element VTKFile", "give a VTU or VTP file");
  const pugi::xml_node grid = root.child("UnstructuredGrid"), poly = root.child("PolyData");
  if (!grid && !poly)
    fail({file}, "has data of the type `" + raster::excerpt(root.attribute("type").value()) + "`, not a mesh of faces",
         "save it as an unstructured grid or poly data");
  const VtkArrays arrays(root, divided.appended, file);
  PolygonMesh mesh{.sections = {{0, ""}}, .objects = {{"default"}}};
  for (const std::string& name : cellData) mesh.arrays.push_back({name});
  std::uint32_t leftOut = 0;
  requireMemoryFor((grid ? grid : poly).children("Piece"), file);
  for (const pugi::xml_node& piece : (grid ? grid : poly).children("Piece"))
    PieceReader(arrays, file, mesh, leftOut).read(piece, !grid);
  finishVtkMesh(mesh, leftOut, file);
  return mesh;
}

}  // namespace hemitex::radiosity
