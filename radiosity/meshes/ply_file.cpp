/// Reads PLY: the positions of vertices and the faces. Text, and binary of both byte orders.
/// Source: G. Turk, The PLY polygon file format, 1994.
#include <algorithm>
#include <cmath>
#include <vector>

#include "radiosity/images/image.h"
#include "radiosity/meshes/mesh_formats.h"
#include "radiosity/meshes/number_source.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// A number of each element, or a list of numbers.
struct Property {
  std::string name;
  NumberType type;
  std::optional<NumberType> countType = {};  ///< of a list
};

struct Element {
  std::string name;
  std::uint32_t count = 0;
  std::vector<Property> properties = {};
};

struct Header {
  NumberEncoding encoding = NumberEncoding::Text;
  std::vector<Element> elements = {};
  std::string_view body = {};
  int bodyLine = 0;
  bool hasTexture = false;  ///< a comment names one, as MeshLab writes it
};

NumberEncoding encodingNamed(std::string_view name, const Place& place) {
  if (name == "ascii") return NumberEncoding::Text;
  if (name == "binary_little_endian") return NumberEncoding::LittleEndian;
  if (name == "binary_big_endian") return NumberEncoding::BigEndian;
  fail(place, "'" + raster::excerpt(name) + "' is no format of a PLY file",
       "it is ascii, binary_little_endian or binary_big_endian");
}

Header parseHeader(std::string_view bytes, const std::filesystem::path& file) {
  Header header{.body = bytes};
  for (;;) {
    const Place place{file, ++header.bodyLine};
    const std::size_t end = header.body.find('\n');
    if (end == std::string_view::npos) fail(place, "the header of the PLY file has no end", "give the whole file");
    std::string_view rest = header.body.substr(0, end);
    header.body.remove_prefix(end + 1);
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    const auto word = [&rest, place] {
      const auto found = nextWord(rest);
      if (!found) fail(place, "a word is missing in the header");
      return *found;
    };
    const std::string_view keyword = nextWord(rest).value_or("");
    if (keyword == "end_header") break;
    if (keyword == "comment" && nextWord(rest) == "TextureFile") header.hasTexture = true;
    if (keyword == "format") header.encoding = encodingNamed(word(), place);
    if (keyword == "element") {
      const std::string name(word());
      header.elements.push_back({name, static_cast<std::uint32_t>(takeIndex(rest, 0xffffffff, place))});
    }
    if (keyword == "property") {
      if (header.elements.empty()) fail(place, "a property stands before the first element");
      std::string_view type = word();
      std::optional<NumberType> countType;
      if (type == "list") {
        countType = typeNamed(word(), place);
        type = word();
      }
      header.elements.back().properties.push_back({std::string(word()), typeNamed(type, place), countType});
    }
  }
  ++header.bodyLine;
  return header;
}

/// The mesh grows as elements are read.
class Body {
 public:
  Body(const Header& header, const std::filesystem::path& file)
      : source_(header.body, header.encoding, {file, header.encoding == NumberEncoding::Text ? header.bodyLine : 0}) {}

  void read(const Element& element) {
    if (element.properties.empty()) return;
    for (std::uint32_t e = 0; e < element.count; ++e) {
      if (element.name == "vertex") {
        readVertex(element);
      } else if (element.name == "face") {
        readFace(element);
      } else if (element.name == "tristrips") {
        readStrips(element);
      } else {
        for (const Property& property : element.properties) skip(property);
      }
    }
  }

  PolygonMesh mesh{.sections = {{0, ""}}, .objects = {{"default"}}};

 private:
  void readVertex(const Element& element) {
    glm::dvec3 position(0.0);
    glm::dvec3 colour(1.0);
    bool hasColour = false;
    for (const Property& property : element.properties) {
      const int axis = indexIn(" x y z ", property), channel = indexIn(" red green blue ", property);
      if (axis >= 0) {
        position[axis] = source_.next(property.type);
      } else if (channel >= 0) {
        colour[channel] = source_.next(property.type) / whiteOf(property.type);
        hasColour = true;
      } else {
        skip(property);
      }
    }
    addPosition(mesh, position, source_.place());
    if (hasColour) setColour(mesh, decodeSrgb(colour));
  }

  /// The number of a property among three names; -1 for others.
  static int indexIn(std::string_view names, const Property& property) {
    const std::size_t at = names.find(" " + property.name + " ");
    if (at == names.npos || property.countType) return -1;
    return static_cast<int>(std::count(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(at), ' '));
  }

  /// The value of a full channel of a colour.
  static double whiteOf(NumberType type) {
    return type == NumberType::Uint8 ? 255 : type == NumberType::Uint16 ? 65535 : 1;
  }

  void readFace(const Element& element) {
    std::vector<std::uint32_t> corners;
    forEachIndex(element, [&](double index) { corners.push_back(vertexAt(index)); });
    addPolygon(mesh, corners, source_.place());
  }

  /// A negative index ends a strip.
  void readStrips(const Element& element) {
    std::vector<std::uint32_t> strip;
    forEachIndex(element, [&](double index) {
      if (index >= 0) return strip.push_back(vertexAt(index));
      addStrip(mesh, strip, source_.place());
      strip.clear();
    });
    addStrip(mesh, strip, source_.place());
  }

  /// Calls visit(number) for the vertices of a face or of strips.
  template <typename Visit>
  void forEachIndex(const Element& element, const Visit& visit) {
    for (const Property& property : element.properties) {
      if (!property.countType || (property.name != "vertex_indices" && property.name != "vertex_index")) {
        skip(property);
        continue;
      }
      const std::uint32_t count = source_.nextIndex(*property.countType, 0xffffffff);
      source_.require(property.type, count);
      for (std::uint32_t c = 0; c < count; ++c) visit(source_.next(property.type));
    }
  }

  std::uint32_t vertexAt(double index) const {
    if (!(index >= 0 && index <= 0xffffffff && index == std::floor(index)))
      fail(source_.place(), "a number should be the number of a vertex", "give the whole file");
    return static_cast<std::uint32_t>(index);
  }

  void skip(const Property& property) {
    source_.skip(property.type, property.countType ? source_.nextIndex(*property.countType, 0xffffffff) : 1);
  }

  NumberSource source_;
};

}  // namespace

PolygonMesh parsePly(std::string_view bytes, const std::filesystem::path& file) {
  if (!bytes.starts_with("ply")) fail({file, 1}, "does not begin with `ply`", "give a PLY file");
  const Header header = parseHeader(bytes, file);
  Body body(header, file);
  for (const Element& element : header.elements) body.read(element);
  const auto isColoured = [](const Element& element) {
    return element.name == "face" && std::any_of(element.properties.begin(), element.properties.end(),
                                                 [](const Property& property) { return property.name == "red"; });
  };
  if (std::any_of(header.elements.begin(), header.elements.end(), isColoured))
    body.mesh.warnings.push_back("the colours of faces are left out");
  if (header.hasTexture) body.mesh.warnings.push_back("the image of its comment TextureFile is left out");
  if (body.mesh.polygons.empty()) fail({file}, "has no face: it may be a cloud of points", "give a mesh with faces");
  return std::move(body.mesh);
}

}  // namespace hemitex::radiosity
