#include "radiosity/meshes/obj_file.h"

#include <algorithm>
#include <array>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/trim_all.hpp>
#include <cmath>
#include <map>
#include <utility>

#include "radiosity/base/text_lines.h"
#include "radiosity/images/image.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

/// `fo` is the older keyword of the same.
bool isFace(const TextLine& line) { return line.keyword == "f" || line.keyword == "fo"; }

/// Collects the statements that are left out although they may change the light.
class OmittedStatements {
 public:
  void read(const TextLine& line) {
    // Those of this reader, and those that change no light: smoothing groups, points of curves, displays and comments.
    constexpr std::string_view harmless =
        " v vt vn f fo g o usemtl mtllib s mg vp bevel c_interp d_interp lod shadow_obj trace_obj ctech stech cstype "
        "deg "
        "bmat step parm trim hole scrv sp end con ";
    if (harmless.find(" " + std::string(line.keyword) + " ") != harmless.npos) return;
    lines_.try_emplace(std::string(line.keyword), line.number);
  }

  void warn(std::vector<std::string>& warnings) const {
    constexpr std::size_t maxNames = 8;
    std::string names;
    std::size_t count = 0;
    for (const auto& [keyword, line] : lines_)
      if (count++ < maxNames)
        names += (names.empty() ? "`" : ", `") + raster::excerpt(keyword) + "` (line " + std::to_string(line) + ")";
    if (!names.empty()) warnings.push_back("only polygons are read; these statements are left out: " + names);
  }

 private:
  std::map<std::string, int> lines_;  ///< the first one of each keyword
};

/// Parses the lines that hold numbers.
class NumberReader {
 public:
  NumberReader(const std::filesystem::path& file, PolygonMesh& obj) : file_(file), obj_(obj) {}

  void read(const TextLine& line) {
    const Place place{file_, line.number};
    if (line.keyword == "v") readPosition(line.rest, place);
    if (line.keyword == "vt") readTexcoord(line.rest, place);
    if (line.keyword == "vn") readNormal(line.rest, place);
    if (isFace(line)) readPolygon(line.rest, place);
  }

  /// An index may point forward, so that the upper end of the range is known only after the last line.
  void checkRanges() {
    for (const MeshPolygon& polygon : obj_.polygons) {
      const Place place{file_, polygon.line};
      for (std::uint32_t c = polygon.firstCorner; c < polygon.firstCorner + polygon.cornerCount; ++c) {
        const MeshCorner& corner = obj_.corners[c];
        checkRange(corner.position, obj_.positions.size(), "vertices", place);
        if (corner.texcoord) checkRange(*corner.texcoord, obj_.texcoords.size(), "texture coordinates", place);
      }
    }
    checkNormals();
  }

 private:
  /// `v x y z`, with an optional weight `w`, which only curves have a use for, or a colour `r g b`, sRGB-encoded as
  /// Blender and MeshLab write it; a seventh number, alpha, is left out.
  void readPosition(std::string_view rest, const Place& place) {
    std::array<double, 7> n{};
    const std::size_t count = readNumbers(rest, n, place);
    if (count < 3 || count == 5) fail(place, "a vertex has 3 coordinates, and may have a weight or a colour behind");
    addPosition(obj_, {n[0], n[1], n[2]}, place);
    if (count > 5) setColour(obj_, decodeSrgb(glm::dvec3(n[3], n[4], n[5])));
    if (count > 5 && std::max({n[3], n[4], n[5]}) > 1 && !std::exchange(hasBrightColour_, true))
      warn("a colour of a vertex is above 1, and becomes 1", place.line);
    if (count == 4 && n[3] != 1 && !std::exchange(hasWeight_, true))
      warn("a vertex has a fourth coordinate, which is left out", place.line);
  }

  void warn(const std::string& what, int line) {
    obj_.warnings.push_back(what + " (line " + std::to_string(line) + ", and perhaps others)");
  }

  void readTexcoord(std::string_view rest, const Place& place) {
    std::array<double, 3> n{};
    if (readNumbers(rest, n, place) == 0) fail(place, "a texture coordinate has at least 1 number");
    if (std::max(std::fabs(n[0]), std::fabs(n[1])) > largestCoordinate)
      fail(place, "a texture coordinate is above 1e18 in size", "use coordinates from 0 to 1, or of some repetitions");
    obj_.texcoords.emplace_back(n[0], n[1]);
  }

  void readNormal(std::string_view rest, const Place& place) {
    std::array<double, 3> n{};
    if (readNumbers(rest, n, place) != 3) fail(place, "a normal has 3 numbers");
    obj_.normals.emplace_back(n[0], n[1], n[2]);
  }

  void readPolygon(std::string_view rest, const Place& place) {
    MeshPolygon polygon{.firstCorner = static_cast<std::uint32_t>(obj_.corners.size()), .line = place.line};
    polygon.textured = true;
    for (auto word = nextWord(rest); word; word = nextWord(rest)) {
      obj_.corners.push_back(readCorner(*word, place));
      polygon.textured = polygon.textured && obj_.corners.back().texcoord.has_value();
    }
    polygon.cornerCount = static_cast<std::uint32_t>(obj_.corners.size()) - polygon.firstCorner;
    if (polygon.cornerCount < 3) fail(place, "a face has at least 3 corners");
    obj_.polygons.push_back(polygon);
  }

  /// `v`, `v/vt`, `v//vn` or `v/vt/vn`.
  MeshCorner readCorner(std::string_view word, const Place& place) {
    std::array<std::string_view, 3> parts;
    std::string_view rest = word;
    for (std::size_t part = 0; part < 3; ++part) {
      const std::size_t length = std::min(part < 2 ? rest.find('/') : rest.size(), rest.size());
      parts[part] = rest.substr(0, length);
      rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    MeshCorner corner{resolve(parts[0], obj_.positions.size(), "vertices", place)};
    if (!parts[1].empty()) corner.texcoord = resolve(parts[1], obj_.texcoords.size(), "texture coordinates", place);
    if (!parts[2].empty()) corner.normal = normalAt(readIndex(parts[2], place), place);
    return corner;
  }

  /// The index of a word as written, not 0.
  static int readIndex(std::string_view word, const Place& place) {
    const std::optional<int> index = raster::parseInteger(word);
    if (!index) fail(place, "'" + raster::excerpt(word) + "' is not an index");
    if (*index == 0) fail(place, "index 0 in a face", "indices count from 1");
    return *index;
  }

  /// The index of a word, counted from 0. Positive numbers count from 1, negative numbers back from the last vertex so
  /// far.
  static std::uint32_t resolve(std::string_view word, std::size_t count, const char* what, const Place& place) {
    const int index = readIndex(word, place);
    if (index > 0) return static_cast<std::uint32_t>(index) - 1;
    const std::int64_t resolved = static_cast<std::int64_t>(count) + index;
    if (resolved < 0) {
      fail(place, "index " + std::to_string(index) + " is out of range: there are " + std::to_string(count) + " " +
                      what + " above it");
    }
    return static_cast<std::uint32_t>(resolved);
  }

  static void checkRange(std::uint32_t index, std::size_t count, const char* what, const Place& place) {
    if (index < count) return;
    fail(place,
         "index " + std::to_string(index + 1) + " is out of range: there are " + std::to_string(count) + " " + what);
  }

  /// An index out of range is a warning, because normals only say which edges are smooth.
  std::optional<std::uint32_t> normalAt(int index, const Place& place) {
    const std::int64_t resolved = index > 0 ? index - 1 : static_cast<std::int64_t>(obj_.normals.size()) + index;
    if (resolved >= 0) return static_cast<std::uint32_t>(resolved);
    warnOfNormal(index, place.line);
    return {};
  }

  void checkNormals() {
    for (const MeshPolygon& polygon : obj_.polygons) {
      for (std::uint32_t c = polygon.firstCorner; c < polygon.firstCorner + polygon.cornerCount; ++c) {
        std::optional<std::uint32_t>& normal = obj_.corners[c].normal;
        if (!normal || *normal < obj_.normals.size()) continue;
        warnOfNormal(static_cast<int>(*normal) + 1, polygon.line);
        normal.reset();
      }
    }
  }

  /// Warns of the first face whose normal is out of range.
  void warnOfNormal(int index, int line) {
    if (!std::exchange(hasWarned_, true))
      obj_.warnings.push_back("a face names the normal " + std::to_string(index) + ", which the file lacks (line " +
                              std::to_string(line) + "); faces without normals are smooth by the angle between them");
  }

  const std::filesystem::path& file_;
  PolygonMesh& obj_;
  bool hasWarned_ = false, hasWeight_ = false, hasBrightColour_ = false;
};

/// Assigns polygons to sections.
class StructureReader {
 public:
  explicit StructureReader(PolygonMesh& obj) : obj_(obj) {}

  /// The line of a face is already parsed: its polygon is the last one.
  void read(const TextLine& line) {
    if (isFace(line)) obj_.polygons.back().section = sectionOfFace();
    if (line.keyword == "g") setGroup(withSingleBlanks(line.rest));
    if (line.keyword == "o") setGroup(std::string(line.rest));
    if (line.keyword == "usemtl") setMaterial(std::string(line.rest));
  }

 private:
  /// The names of a group, with one blank between them.
  static std::string withSingleBlanks(std::string_view names) {
    return boost::trim_fill_copy_if(std::string(names), " ", boost::is_any_of(" \t"));
  }

  void setGroup(const std::string& name) {
    group_ = name.empty() ? "default" : name;
    section_.reset();
  }

  void setMaterial(const std::string& name) {
    material_ = name;
    section_.reset();
  }

  std::uint32_t sectionOfFace() {
    if (!section_) {
      const auto object = objects_.try_emplace(group_, obj_.objects.size());
      if (object.second) obj_.objects.push_back({group_});
      const std::uint32_t number = object.first->second;
      const auto known = sections_.try_emplace({number, material_}, obj_.sections.size());
      if (known.second) obj_.sections.push_back({number, material_});
      section_ = known.first->second;
    }
    return *section_;
  }

  PolygonMesh& obj_;
  std::string group_ = "default", material_;  ///< current
  std::map<std::string, std::uint32_t> objects_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> sections_;
  std::optional<std::uint32_t> section_;  ///< of the current group and material, once a face uses it
};

}  // namespace

PolygonMesh readObj(const std::filesystem::path& file) {
  return parseObj(raster::readFile(file, "check the path, and that it is a file you may read"), file);
}

PolygonMesh parseObj(std::string_view text, const std::filesystem::path& file) {
  PolygonMesh obj;
  NumberReader numbers(file, obj);
  StructureReader structure(obj);
  OmittedStatements omitted;
  const std::optional<std::string> joined = joinedLines(text);
  LineReader lines(joined ? *joined : text, file);
  while (const std::optional<TextLine> line = lines.next()) {
    numbers.read(*line);
    structure.read(*line);
    omitted.read(*line);
    if (line->keyword == "mtllib" && !line->rest.empty()) obj.materialLibraries.emplace_back(line->rest);
  }
  numbers.checkRanges();
  omitted.warn(obj.warnings);
  return obj;
}

}  // namespace hemitex::radiosity
