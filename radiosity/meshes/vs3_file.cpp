/// Reads the geometry of View3D (`.vs3`) in the format `3`: vertices and surfaces with 3 or 4 of them.
/// Source: View3D 3.3 (NIST), doc/view3d-manual.tex and src/getdat.c.
#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "radiosity/meshes/mesh_formats.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

class Vs3Reader {
 public:
  explicit Vs3Reader(const std::filesystem::path& file) : file_(file) {}

  /// Reads a line; false at the line that ends the data.
  bool read(const TextLine& line) {
    const Place place{file_, line.number};
    std::string_view rest = line.rest.substr(0, line.rest.find('!'));
    switch (std::toupper(static_cast<unsigned char>(line.keyword.front()))) {
      case 'V':
        readVertex(rest, place);
        break;
      case 'S':
        readSurface(rest, place, true);
        break;
      case 'O':
        readSurface(rest, place, false);
        break;
      case 'F':
        if (const auto word = nextWord(rest); !word || *word != "3")
          fail(place, "only the format 3 of View3D is read, with vertices and surfaces",
               "give a file with the line F 3");
        break;
      case 'M':
      case 'N':
        fail(place, "a surface that masks another is not read", "leave it out");
      case 'E':
      case '*':
        return false;
      case 'T':
      case 'C':
      case 'X':
      case '/':
      case '!':
        break;
      default:
        fail(place, "`" + raster::excerpt(line.keyword) + "` is no line of a View3D file");
    }
    return true;
  }

  PolygonMesh finish() {
    if (combined_ > 0)
      mesh_.warnings.push_back(std::to_string(combined_) +
                               " surfaces are combined with others in View3D; here each is a face of its own");
    return std::move(mesh_);
  }

 private:
  void requireNext(std::string_view& rest, std::size_t count, const char* what, const Place& place) {
    if (takeIndex(rest, 0xffffffff, place) != count + 1)
      fail(place, std::string("the number of the ") + what + " should be " + std::to_string(count + 1));
  }

  void readVertex(std::string_view rest, const Place& place) {
    requireNext(rest, mesh_.positions.size(), "vertex", place);
    std::array<double, 3> n{};
    if (readNumbers(rest, n, place) != 3) fail(place, "a vertex has 3 coordinates");
    addPosition(mesh_, {n[0], n[1], n[2]}, place);
  }

  void readSurface(std::string_view rest, const Place& place, bool radiates) {
    requireNext(rest, mesh_.polygons.size(), "surface", place);
    std::vector<std::uint32_t> corners;
    for (int corner = 0; corner < 4; ++corner) {
      const auto vertex = static_cast<std::uint32_t>(takeIndex(rest, mesh_.positions.size(), place));
      if (vertex == 0 && corner < 3) fail(place, "vertices count from 1");
      if (vertex > 0) corners.push_back(vertex - 1);
    }
    std::string name = "obstruction";
    double reflectance = 0;
    if (radiates) {
      if (takeIndex(rest, 0xffffffff, place) != 0)
        fail(place, "a surface inside of another is not read", "divide the other one into surfaces beside it");
      if (takeIndex(rest, 0xffffffff, place) != 0) ++combined_;
      const double emittance = readNumber(nextWord(rest).value_or("1"), place);
      if (!(emittance >= 0 && emittance <= 1)) fail(place, "an emittance is from 0 to 1");
      reflectance = 1 - emittance;
      name = std::string(nextWord(rest).value_or("surface"));
    }
    startSection(name);
    addPolygon(mesh_, corners, place);
    mesh_.polygons.back().section = sections_.at(name);
    mesh_.arrays.front().values.push_back(reflectance);
  }
  void startSection(const std::string& name) {
    if (sections_.try_emplace(name, static_cast<std::uint32_t>(mesh_.sections.size())).second) {
      mesh_.sections.push_back({static_cast<std::uint32_t>(mesh_.objects.size()), ""});
      mesh_.objects.push_back({name});
    }
  }

  const std::filesystem::path& file_;
  PolygonMesh mesh_{.arrays = {{"reflectance"}}};
  std::map<std::string, std::uint32_t> sections_;
  int combined_ = 0;
};

}  // namespace

PolygonMesh parseVs3(std::string_view text, const std::filesystem::path& file) {
  Vs3Reader reader(file);
  LineReader lines(text, file);
  for (auto line = lines.next(); line && reader.read(*line);) line = lines.next();
  return reader.finish();
}

}  // namespace hemitex::radiosity
