/// Reads VTK's legacy files (`.vtk`) with poly data or an unstructured grid; text and binary, versions 1 to 5.
/// Source: VTK File Formats (Kitware), section Simple Legacy Formats.
#include <algorithm>

#include "radiosity/meshes/mesh_formats.h"
#include "radiosity/meshes/number_source.h"
#include "radiosity/meshes/vtk_cells.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

constexpr std::uint32_t anyIndex = 0xffffffff;

/// Lists of points, one per cell.
struct Cells {
  std::vector<std::uint32_t> start{0}, points = {};
  std::size_t count() const { return start.size() - 1; }
  std::span<const std::uint32_t> of(std::size_t cell) const {
    return std::span(points).subspan(start[cell], start[cell + 1] - start[cell]);
  }
};

class LegacyReader {
 public:
  LegacyReader(std::string_view bytes, const std::filesystem::path& file, std::span<const std::string> cellData)
      : rest_(bytes), file_(file) {
    for (const std::string& name : cellData) mesh_.arrays.push_back({name});
  }

  PolygonMesh read() {
    if (!line().starts_with("# vtk DataFile Version")) fail("does not begin with `# vtk DataFile Version`");
    line();  // the title
    std::string_view kind = line();
    const auto word = nextWord(kind);
    if (word != "ASCII" && word != "BINARY") fail("the third line is neither ASCII nor BINARY");
    encoding_ = word == "BINARY" ? NumberEncoding::BigEndian : NumberEncoding::Text;
    while (!rest_.empty() && readSection()) {
    }
    std::vector<std::uint32_t> faces;  // the numbers of the cells that are faces, in the order of cell data
    const std::uint32_t others = leftOut_;
    for (std::size_t cell = 0; cell < cells_.count(); ++cell) {
      if (!types_.empty() && types_.size() != cells_.count()) fail("there are not as many types as cells");
      addVtkCell(mesh_, types_.empty() ? vtkPolygon : types_[cell], cells_.of(cell), {file_}, leftOut_);
      faces.resize(mesh_.polygons.size(), others + static_cast<std::uint32_t>(cell));
    }
    cellCount_ = others + static_cast<std::uint32_t>(cells_.count());
    if (!mesh_.arrays.empty()) readData(faces);
    finishVtkMesh(mesh_, leftOut_, file_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    radiosity::fail(place(), what, "give a legacy VTK file with poly data or an unstructured grid");
  }
  Place place() const { return {file_, encoding_ == NumberEncoding::Text ? line_ : 0}; }

  std::string_view line() {
    ++line_;
    const auto end = static_cast<std::size_t>(std::find(rest_.begin(), rest_.end(), '\n') - rest_.begin());
    std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (found.ends_with('\r')) found.remove_suffix(1);
    return found;
  }

  /// Reads a keyword with its numbers; false at the data of points or cells, which end the geometry.
  bool readSection() {
    std::string_view words = line();
    const std::string_view keyword = nextWord(words).value_or("");
    if (beginsData(keyword, words)) return false;
    if (keyword == "DATASET") {
      const auto kind = nextWord(words);
      if (kind != "POLYDATA" && kind != "UNSTRUCTURED_GRID")
        fail("the data set " + raster::excerpt(kind.value_or("")) + " is no mesh of faces");
    } else if (keyword == "POINTS") {
      readPoints(words);
    } else if (keyword == "POLYGONS") {
      readCells(words);
      types_.resize(cells_.count(), vtkPolygon);
    } else if (keyword == "CELLS") {
      readCells(words);
    } else if (keyword == "CELL_TYPES") {
      const std::uint32_t count = number(words);
      NumberSource source = numbers(NumberType::Int32, count);
      for (std::uint32_t c = 0; c < count; ++c) types_.push_back(source.nextIndex(NumberType::Int32, 255));
      goBehind(source);
    } else if (keyword == "VERTICES" || keyword == "LINES") {
      Cells ignored;
      std::swap(ignored, cells_);
      readCells(words);
      std::swap(ignored, cells_);
      leftOut_ += static_cast<std::uint32_t>(ignored.count());
    } else if (keyword == "TRIANGLE_STRIPS") {
      readCells(words);
      types_.resize(cells_.count(), vtkStrip);
    } else if (keyword == "METADATA") {
      skipMetadata();
    } else if (!keyword.empty()) {
      fail("`" + raster::excerpt(keyword) + "` is not expected here");
    }
    return true;
  }

  /// Whether a line begins the data of points or cells; remembers which.
  bool beginsData(std::string_view keyword, std::string_view& words) {
    if (keyword != "POINT_DATA" && keyword != "CELL_DATA") return false;
    isOfCells_ = keyword == "CELL_DATA";
    dataCount_ = number(words);
    return true;
  }

  /// Reads the data of points and cells, behind the line that begins them, into the arrays of the mesh.
  void readData(std::span<const std::uint32_t> faces) {
    while (!rest_.empty()) {
      std::string_view words = line();
      const std::string keyword(nextWord(words).value_or(""));
      if (keyword.empty()) continue;
      if (beginsData(keyword, words)) continue;
      if (keyword == "METADATA") {
        skipMetadata();
        continue;
      }
      const std::string name(nextWord(words).value_or(""));
      const auto typeOf = [&] { return typeNamed(nextWord(words).value_or(""), place()); };
      if (keyword == "FIELD") {
        readField(number(words), faces);
      } else if (keyword == "SCALARS") {
        const NumberType type = typeOf();
        const std::uint32_t components = words.find_first_not_of(" \t") == words.npos ? 1 : number(words);
        if (!line().starts_with("LOOKUP_TABLE")) fail("LOOKUP_TABLE is missing behind SCALARS");
        readArray(name, type, components, dataCount_, faces);
      } else if (keyword == "LOOKUP_TABLE") {
        skipColours(number(words), 4);
      } else if (keyword == "COLOR_SCALARS") {
        skipColours(dataCount_, number(words));
      } else if (keyword == "TEXTURE_COORDINATES") {
        const std::uint32_t components = number(words);
        readArray(name, typeOf(), components, dataCount_, faces);
      } else if (keyword == "VECTORS" || keyword == "NORMALS" || keyword == "TENSORS") {
        readArray(name, typeOf(), keyword == "TENSORS" ? 9 : 3, dataCount_, faces);
      } else {
        fail("`" + raster::excerpt(keyword) + "` is not expected in data of points and cells");
      }
    }
    for (const FaceArray& array : mesh_.arrays)
      if (array.values.empty()) fail("has no cell data `" + raster::excerpt(array.name) + "`");
  }

  /// Lines `name components tuples type`, each with its numbers.
  void readField(std::uint32_t arrays, std::span<const std::uint32_t> faces) {
    while (arrays > 0 && !rest_.empty()) {
      std::string_view words = line();
      const std::string name(nextWord(words).value_or(""));
      if (name.empty()) continue;
      if (name == "METADATA") {
        skipMetadata();
        continue;
      }
      const std::uint32_t components = number(words), tuples = number(words);
      readArray(name, typeNamed(nextWord(words).value_or(""), place()), components, tuples, faces);
      --arrays;
    }
  }

  void readArray(const std::string& name, NumberType type, std::uint32_t components, std::uint32_t tuples,
                 std::span<const std::uint32_t> faces) {
    const std::uint64_t count = std::uint64_t{components} * tuples;
    NumberSource source = numbers(type, count);
    const auto wanted = std::find_if(mesh_.arrays.begin(), mesh_.arrays.end(), [&](const FaceArray& array) {
      return isOfCells_ && array.name == name && array.values.empty();
    });
    if (wanted == mesh_.arrays.end()) {
      source.skip(type, count);
    } else {
      if (tuples != cellCount_) fail("the cell data `" + raster::excerpt(name) + "` are not one per cell");
      std::vector<double> values(count);
      for (double& value : values) value = source.next(type);
      addCellValues(*wanted, static_cast<int>(std::min(components, 100U)), values, faces, place());
    }
    goBehind(source);
  }

  /// Colours are bytes in binary files, numbers in text.
  void skipColours(std::uint32_t count, std::uint32_t components) {
    NumberSource source = numbers(NumberType::Uint8, std::uint64_t{count} * components);
    source.skip(NumberType::Uint8, std::size_t{count} * components);
    goBehind(source);
  }

  void skipMetadata() {
    while (!rest_.empty() && line().find_first_not_of(" \t") != std::string_view::npos) {
    }
  }

  std::uint32_t number(std::string_view& words) {
    return static_cast<std::uint32_t>(takeIndex(words, anyIndex, place()));
  }

  NumberSource numbers(NumberType type, std::uint64_t count) {
    NumberSource source(rest_, encoding_, {file_, line_ + 1});
    source.require(type, count);
    return source;
  }
  void goBehind(const NumberSource& source) {
    if (encoding_ == NumberEncoding::Text) line_ = source.place().line - 1;
    rest_ = source.rest();
  }

  void readPoints(std::string_view words) {
    const std::uint32_t count = number(words);
    const NumberType type = typeNamed(nextWord(words).value_or(""), place());
    NumberSource source = numbers(type, std::uint64_t{count} * 3);
    for (std::uint32_t p = 0; p < count; ++p) {
      glm::dvec3 point;
      for (int axis = 0; axis < 3; ++axis) point[axis] = source.next(type);
      addPosition(mesh_, point, source.place());
    }
    goBehind(source);
  }

  /// `count size`, then lists with their lengths; since version 5 offsets and points in arrays of their own.
  void readCells(std::string_view words) {
    const std::uint32_t count = number(words), size = number(words);
    const std::string_view before = rest_;
    const int lineBefore = line_;
    std::string_view next = line();
    if (nextWord(next) == "OFFSETS") return readOffsets(count, size, typeNamed(nextWord(next).value_or(""), place()));
    rest_ = before;
    line_ = lineBefore;
    NumberSource source = numbers(NumberType::Int32, size);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t length = source.nextIndex(NumberType::Int32, size);
      source.require(NumberType::Int32, length);
      for (std::uint32_t i = 0; i < length; ++i) cells_.points.push_back(source.nextIndex(NumberType::Int32, anyIndex));
      cells_.start.push_back(static_cast<std::uint32_t>(cells_.points.size()));
    }
    goBehind(source);
  }

  void readOffsets(std::uint32_t count, std::uint32_t size, NumberType type) {
    NumberSource offsets = numbers(type, count);
    const auto before = static_cast<std::uint32_t>(cells_.points.size());
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t start = offsets.nextIndex(type, size) + before;
      if (c == 0 ? start != before : start < cells_.start.back()) fail("the offsets of cells do not ascend from 0");
      if (c > 0) cells_.start.push_back(start);
    }
    if (count > 0 && cells_.start.back() != before + size) fail("the last offset is not the number of points of cells");
    goBehind(offsets);
    std::string_view words;
    while (!rest_.empty() && words.empty()) words = line();
    if (nextWord(words) != "CONNECTIVITY") fail("CONNECTIVITY is missing behind the offsets");
    const NumberType pointType = typeNamed(nextWord(words).value_or(""), place());
    NumberSource points = numbers(pointType, size);
    for (std::uint32_t i = 0; i < size; ++i) cells_.points.push_back(points.nextIndex(pointType, anyIndex));
    goBehind(points);
  }

  std::string_view rest_;
  const std::filesystem::path& file_;
  NumberEncoding encoding_ = NumberEncoding::Text;
  int line_ = 0;
  PolygonMesh mesh_{.sections = {{0, ""}}, .objects = {{"default"}}};
  Cells cells_;
  std::vector<std::uint32_t> types_;
  std::uint32_t leftOut_ = 0, cellCount_ = 0;
  bool isOfCells_ = false;  ///< whether data are of cells, not of points
  std::uint32_t dataCount_ = 0;
};

}  // namespace

PolygonMesh parseLegacyVtk(std::string_view bytes, const std::filesystem::path& file,
                           std::span<const std::string> cellData) {
  return LegacyReader(bytes, file, cellData).read();
}

}  // namespace hemitex::radiosity
