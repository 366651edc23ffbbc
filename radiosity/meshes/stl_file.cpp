#include "radiosity/meshes/stl_file.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "radiosity/meshes/number_source.h"

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
    for (int axis = 0; axis < 3; ++axis) result[axis] = source.next(NumberType::Float32);
    return result;
  };
  while (!source.rest().empty()) {
    const glm::dvec3 normal = vector();
    for (int corner = 0; corner < 3; ++corner) addPosition(mesh, vector(), source.place());
    source.skip(NumberType::Uint16, 1);
    addTriangle(mesh, normal, source.place(), contradicted);
  }
  warnOfNormals(mesh, contradicted);
  return mesh;
}

std::string lower(std::string_view word) {
  std::string result(word);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

/// The three numbers of a line; 0 if it has none.
glm::dvec3 vectorOf(std::string_view rest, const Place& place) {
  std::array<double, 3> n{};
  if (readNumbers(rest, n, place) != 3) fail(place, "three numbers are missing");
  return {n[0], n[1], n[2]};
}

PolygonMesh parseText(std::string_view text, const std::filesystem::path& file) {
  PolygonMesh mesh;
  std::uint32_t contradicted = 0;
  std::size_t firstVertex = 0;  // of the facet
  glm::dvec3 normal(0.0);
  LineReader lines(text, file);
  bool isOpen = false, isFacet = false;
  while (const auto line = lines.next()) {
    const Place place = lines.place();
    const std::string keyword = lower(line->keyword);
    if (keyword == "solid" && !isOpen) {
      mesh.sections.push_back({static_cast<std::uint32_t>(mesh.objects.size()), ""});
      mesh.objects.push_back({line->rest.empty() ? "default" : std::string(line->rest)});
      isOpen = true;
    } else if (keyword == "facet" && isOpen && !isFacet) {
      isFacet = true;
      firstVertex = mesh.positions.size();
      std::string_view rest = line->rest;
      if (const auto word = nextWord(rest); word && lower(*word) == "normal") normal = vectorOf(rest, place);
    } else if (keyword == "vertex" && isFacet) {
      addPosition(mesh, vectorOf(line->rest, place), place);
    } else if (keyword == "endfacet" && isFacet) {
      if (mesh.positions.size() != firstVertex + 3) fail(place, "a facet has three vertices");
      addTriangle(mesh, normal, place, contradicted);
      isFacet = false;
    } else if (keyword == "endsolid" && isOpen && !isFacet) {
      isOpen = false;
    } else if ((keyword != "outer" && keyword != "endloop") || !isFacet) {
      fail(place, "`" + std::string(keyword.substr(0, 40)) + "` is not expected here in an STL file",
           "give a text or binary STL file");
    }
  }
  if (isOpen || mesh.sections.empty()) fail(lines.place(), "the STL file ends without endsolid", "give the whole file");
  warnOfNormals(mesh, contradicted);
  return mesh;
}

/// Whether the length is that of a binary file with the number of triangles in its header.
bool isBinary(std::string_view bytes, const std::filesystem::path& file) {
  if (bytes.size() < headerBytes + 4 || (bytes.size() - headerBytes - 4) % triangleBytes != 0) return false;
  NumberSource header(bytes.substr(headerBytes), NumberEncoding::LittleEndian, {file});
  return header.next(NumberType::Uint32) == static_cast<double>((bytes.size() - headerBytes - 4) / triangleBytes);
}

}  // namespace

PolygonMesh parseStl(std::string_view bytes, const std::filesystem::path& file) {
  if (isBinary(bytes, file)) return parseBinary(bytes, file);
  if (lower(bytes.substr(0, 5)) == "solid") return parseText(bytes, file);
  fail({file}, "is no STL file: it neither begins with `solid` nor has the length that a binary header announces",
       "give the whole file");
}

}  // namespace hemitex::radiosity
