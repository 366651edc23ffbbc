#include "radiosity/meshes/vtu_file.h"

#include <bit>
#include <cassert>
#include <ostream>

#include "radiosity/meshes/vtk_cells.h"
#include "raster/base/file_io.h"

namespace hemitex::radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are in memory");

/// The elements DataArray of a file, and the bytes that they refer to.
class AppendedArrays {
 public:
  /// The element of an array, which must live until it is written.
  template <typename Number>
  std::string add(const std::string& name, const std::string& type, int components, std::span<const Number> numbers) {
    const std::string element = "<DataArray Name=\"" + name + "\" type=\"" + type + "\" NumberOfComponents=\"" +
                                std::to_string(components) + "\" format=\"appended\" offset=\"" +
                                std::to_string(offset_) + "\"/>\n";
    arrays_.push_back(std::as_bytes(numbers));
    offset_ += sizeof(std::uint64_t) + arrays_.back().size();
    return element;
  }

  /// Each array is its number of bytes, then these.
  void write(std::ostream& stream) const {
    for (const std::span<const std::byte> bytes : arrays_) {
      const std::uint64_t count = bytes.size();
      stream.write(reinterpret_cast<const char*>(&count), sizeof count);
      stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
  }

 private:
  std::vector<std::span<const std::byte>> arrays_;
  std::uint64_t offset_ = 0;
};

}  // namespace

void writeVtu(const std::filesystem::path& file, const PolygonMesh& mesh, std::span<const FaceArray> arrays) {
  std::vector<std::int64_t> points, ends;
  std::vector<std::uint8_t> types;
  for (const MeshPolygon& polygon : mesh.polygons) {
    for (const MeshCorner& corner : std::span(mesh.corners).subspan(polygon.firstCorner, polygon.cornerCount))
      points.push_back(corner.position);
    ends.push_back(static_cast<std::int64_t>(points.size()));
    types.push_back(polygon.cornerCount == 3 ? vtkTriangle : vtkPolygon);
  }
  AppendedArrays appended;
  std::string cellData;
  for (const FaceArray& array : arrays) {
    assert(array.values.size() == mesh.polygons.size() * static_cast<std::size_t>(array.components));
    cellData += appended.add(array.name, "Float64", array.components, std::span(array.values));
  }
  const std::string positions =
      appended.add("Points", "Float64", 3,
                   std::span(reinterpret_cast<const double*>(mesh.positions.data()), 3 * mesh.positions.size()));
  const std::string connectivity = appended.add("connectivity", "Int64", 1, std::span<const std::int64_t>(points));
  const std::string offsets = appended.add("offsets", "Int64", 1, std::span<const std::int64_t>(ends));
  const std::string cellTypes = appended.add("types", "UInt8", 1, std::span<const std::uint8_t>(types));
  const std::string scalars = arrays.empty() ? "" : " Scalars=\"" + arrays.front().name + "\"";
  const std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      std::to_string(mesh.positions.size()) + "\" NumberOfCells=\"" + std::to_string(mesh.polygons.size()) +
      "\">\n<CellData" + scalars + ">\n" + cellData + "</CellData>\n<Points>\n" + positions + "</Points>\n<Cells>\n" +
      connectivity + offsets + cellTypes +
      "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  raster::writeFile(file, [&](std::ostream& stream) {
    stream << xml;
    appended.write(stream);
    stream << "\n</AppendedData>\n</VTKFile>\n";
  });
}

}  // namespace hemitex::radiosity
