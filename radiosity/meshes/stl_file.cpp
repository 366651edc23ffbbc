/// Reads STL, text and binary. All vertices are of their triangles alone.
/// Source: M. Burns, Automated Fabrication, 1993, section 6.5.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "radiosity/meshes/mesh_formats.h"
#include "radiosity/meshes/number_source.h"
#include "raster/base/lower_case.h"

namespace hemitex::radiosity {
namespace {

constexpr std::size_t headerBytes = 80, triangleBytes = 50;

/// Adds the last three positions as a triangle.
void addTriangle(PolygonMesh& mesh, const glm::dvec3& normal, const Place& place, std::uint32_t& contradicted) {
  const auto end = static_cast<std::uint32_t>(mesh.positions.size());
  addPolygon(mesh, std::array{end - 3, end - 2, end - 1}, place);
  const auto corner = [&](std::uint32_t back) { return mesh.positions[end - back]; };
  if (glm::dot(glm::cross(corner(2) - corner(3), corner(1) - corner(3)), normal) < 0 && contradicted++ == 0)
    mesh.warnings.push_back(placeOf(mesh, static_cast<std::uint32_t>(mesh.polygons.size() - 1)));
}

/// Replaces the place of the first triangle by a sentence.
void warnOfNormals(PolygonMesh& mesh, std::uint32_t contradicted) {
  if (contradicted == 0) return;
  mesh.warnings.back() = std::to_string(contradicted) + (contradicted == 1 ? " face winds" : " faces wind") +
                         " against its normal (" + mesh.warnings.back() +
                         "); the order of the vertices says which side is the front";
}

PolygonMesh parseBinary(std::string_view bytes, const std::filesystem::path& file) {
  PolygonMesh mesh{.sections = {{0, ""}}, .objects = {{"default"}}};
  std::uint32_t contradicted = 0;
  NumberSource source(bytes.substr(headerBytes + 4), NumberEncoding::LittleEndian, {file});
  const auto vector = [&] {
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis) result[axis] = source.nextAny(NumberType::Float32);
    return result;
  };
  bool hasColours = bytes.substr(0, headerBytes).find("COLOR=") != bytes.npos;
  while (!source.rest().empty()) {
    const glm::dvec3 normal = vector();
    for (int corner = 0; corner < 3; ++corner) addPosition(mesh, vector(), source.place());
    constexpr int colourBit = 0x8000;  // of programs that write colours where the format has a length
    if (source.nextIndex(NumberType::Uint16, 0xffff) >= colourBit) hasColours = true;
    addTriangle(mesh, normal, source.place(), contradicted);
  }
  warnOfNormals(mesh, contradicted);
  if (hasColours) mesh.warnings.push_back("the colours of facets are left out");
  return mesh;
}

/// The next words as numbers. Throws InputError if one is missing or no finite number.
glm::dvec3 takeVector(std::string_view& rest, const Place& place) {
  glm::dvec3 vector;
  for (int axis = 0; axis < 3; ++axis) {
    const auto word = nextWord(rest);
    if (!word) fail(place, "three numbers are missing");
    vector[axis] = readNumber(*word, place);
  }
  return vector;
}

/// Reads the words of a text one after the other; programs break lines in different places.
class TextReader {
 public:
  TextReader(std::string_view text, const std::filesystem::path& file) : lines_(text, file) {}

  PolygonMesh read() {
    while (const auto line = lines_.next()) {
      std::string_view rest = line->text;
      while (const auto word = nextWord(rest)) readStatement(raster::lowerCase(std::string(*word)), rest);
    }
    if (isOpen_ || isFacet_ || mesh_.sections.empty())
      fail(lines_.place(), "the STL file ends without endsolid", "give the whole file");
    warnOfNormals(mesh_, contradicted_);
    return std::move(mesh_);
  }

 private:
  void readStatement(std::string keyword, std::string_view& rest) {
    if (keyword == "end") keyword += raster::lowerCase(std::string(nextWord(rest).value_or("")));
    if (keyword == "solid" && !isOpen_) {
      begin(std::exchange(rest, {}));
    } else if (keyword == "facet" && !isFacet_) {
      if (mesh_.sections.empty()) begin({});
      isFacet_ = true;
      firstVertex_ = mesh_.positions.size();
      takeNormal(rest);
    } else if (keyword == "vertex" && isFacet_) {
      addPosition(mesh_, takeVector(rest, lines_.place()), lines_.place());
    } else if (keyword == "endfacet" && isFacet_) {
      if (mesh_.positions.size() != firstVertex_ + 3) fail(lines_.place(), "a facet has three vertices");
      addTriangle(mesh_, normal_, lines_.place(), contradicted_);
      isFacet_ = false;
    } else if (keyword == "endsolid" && isOpen_ && !isFacet_) {
      isOpen_ = false;
      rest = {};  // the name
    } else if ((keyword != "outer" && keyword != "loop" && keyword != "endloop") || !isFacet_) {
      fail(lines_.place(), "`" + keyword.substr(0, 40) + "` is not expected here in an STL file",
           "give a text or binary STL file");
    }
  }

  /// The rest of the line is the name.
  void begin(std::string_view name) {
    mesh_.sections.push_back({static_cast<std::uint32_t>(mesh_.objects.size()), ""});
    const std::size_t first = std::min(name.find_first_not_of(" \t"), name.size());
    mesh_.objects.push_back({first == name.size() ? "default" : std::string(name.substr(first))});
    isOpen_ = true;
  }

  /// Words that are no numbers, such as `-nan(ind)`, say nothing.
  void takeNormal(std::string_view& rest) {
    normal_ = glm::dvec3(0.0);
    std::string_view behind = rest;
    if (const auto word = nextWord(behind); !word || raster::lowerCase(std::string(*word)) != "normal") return;
    for (int axis = 0; axis < 3; ++axis)
      normal_[axis] = numberOf(nextWord(behind).value_or("")).value_or(std::numeric_limits<double>::quiet_NaN());
    rest = behind;
  }

  LineReader lines_;
  PolygonMesh mesh_;
  glm::dvec3 normal_{0.0};
  std::uint32_t contradicted_ = 0;
  std::size_t firstVertex_ = 0;  ///< of the facet
  bool isOpen_ = false, isFacet_ = false;
};

/// The number of triangles in the header of a binary file; nothing if the bytes are too few for a header.
std::optional<std::uint64_t> announced(std::string_view bytes, const std::filesystem::path& file) {
  if (bytes.size() < headerBytes + 4) return std::nullopt;
  NumberSource header(bytes.substr(headerBytes), NumberEncoding::LittleEndian, {file});
  return static_cast<std::uint64_t>(header.next(NumberType::Uint32));
}

/// Whether the first word is one that a text begins with, and no byte near it is of none.
bool isText(std::string_view bytes) {
  constexpr std::size_t looked = 256;
  const std::string start = raster::lowerCase(std::string(bytes.substr(0, looked)));
  const std::size_t first = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == start.npos || start.find('\0') != start.npos) return false;
  return start.compare(first, 5, "solid") == 0 || start.compare(first, 5, "facet") == 0;
}

}  // namespace

PolygonMesh parseStl(std::string_view bytes, const std::filesystem::path& file) {
  if (isText(bytes)) return TextReader(bytes, file).read();
  const std::optional<std::uint64_t> triangles = announced(bytes, file);
  if (!triangles)
    fail({file}, "is no STL file: it neither begins with `solid` nor has a binary header", "give the whole file");
  const std::uint64_t room = (bytes.size() - headerBytes - 4) / triangleBytes;
  if (*triangles > room || *triangles == 0)
    fail({file},
         "announces " + std::to_string(*triangles) + " triangles, and has bytes for " + std::to_string(room) +
             "; a text would begin with `solid`",
         "give the whole file");
  const std::size_t end = headerBytes + 4 + *triangles * triangleBytes;
  PolygonMesh mesh = parseBinary(bytes.substr(0, end), file);
  if (bytes.size() > end)
    mesh.warnings.push_back(std::to_string(bytes.size() - end) + " bytes behind the last triangle are left out");
  return mesh;
}

}  // namespace hemitex::radiosity
