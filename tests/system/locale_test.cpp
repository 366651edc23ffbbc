/// Files under locales whose numbers have decimal commas and dots between thousands: reading and writing is the same as
/// without.
#include <catch2/catch.hpp>
#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "radiosity/meshes/vtu_file.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/file_io.h"
#include "raster/base/short_number.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_profile.h"
#include "reference/matrices/matrix_files.h"
#include "tests/support/glb.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
namespace fs = std::filesystem;
using tests::readAll;
using tests::writeAll;

namespace {

struct Commas : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Sets a locale with decimal commas for C++ and, where the system has one or can make it, for C.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Commas))) {
    const std::string made = (folder_.path / "de_DE.UTF-8").string();
    const std::string command = "localedef -f UTF-8 -i de_DE '" + made + "' >/dev/null 2>&1";
    if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8") && std::system(command.c_str()) == 0) {
      setenv("LOCPATH", folder_.path.c_str(), 1);
      std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
      unsetenv("LOCPATH");
    }
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_NUMERIC, "C");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  static bool ofC() { return *std::localeconv()->decimal_point == ','; }

 private:
  TemporaryFolder folder_;
  std::locale before_;
};

const std::map<std::string, std::string> scenes{
    {"s.obj",
     "mtllib s.mtl\nv 0.5 0 0\nv 1.25 0 0\nv 1.25 1.5 0\nv 0.5 1.5 0\nvt 0.25 0.25\nvt 0.75 0.25\nvt 0.75 0.75\n"
     "usemtl a\ng one\nf 1/1 2/2 3/3\ng two\nusemtl b\nf 1 3 4\n"},
    {"s.stl",
     "solid\nfacet normal 0 0 0\nouter loop\nvertex 0.5 0 0\nvertex 1.25 0 0\nvertex 1.25 1.5 0\nendloop\nendfacet\n"
     "endsolid\n"},
    {"s.ply",
     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
     "property list uchar int vertex_indices\nend_header\n0.5 0 0\n1.25 0 0\n1.25 1.5 0\n3 0 1 2\n"},
    {"s.vtk",
     "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0.5 0 0 1.25 0 0 1.25 1.5 0\n"
     "POLYGONS 1 4\n3 0 1 2\n"},
    {"s.vs3", "F 3\nV 1 0.5 0 0\nV 2 1.25 0 0\nV 3 1.25 1.5 0\nS 1 1 2 3 0 0 0 .5 wall\nEnd of data\n"}};

std::string glb() {
  const float corners[9] = {0.5F, 0, 0, 1.25F, 0, 0, 1.25F, 1.5F, 0};
  const auto description = nlohmann::json::parse(
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
          "nodes": [{"mesh": 0, "translation": [0.5, 0.25, 0.125]}],
          "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1]}}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
          "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                         "min": [0.5, 0, 0], "max": [1.25, 1.5, 0]}],
          "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36}]})");
  return tests::glbBytes({description, std::string(reinterpret_cast<const char*>(corners), sizeof corners)});
}

/// All numbers of a scene, as text.
std::string numbersOf(const radiosity::Scene& scene) {
  std::string text;
  const auto add = [&](const auto& vector) {
    for (int k = 0; k < vector.length(); ++k) text += raster::toText(vector[k]) + ' ';
  };
  for (const radiosity::Material& material : scene.materials) {
    text += material.name + ' ';
    add(material.reflectance);
    add(material.emission);
  }
  for (const radiosity::Surface& surface : scene.surfaces)
    for (const radiosity::Triangle& triangle : surface.triangles) {
      for (const auto& position : triangle.position) add(position);
      for (const auto& corner : triangle.chart) add(corner);
    }
  for (const std::string& warning : scene.warnings) text += warning + '\n';
  return text;
}

/// Reads and writes every format in a folder. Returns what was read, and keeps what was written.
std::string exchanged(const fs::path& folder) {
  std::string text;
  writeAll(folder / "s.mtl", "newmtl a\nKd spectral p.rfl 0.5\nKe 0.25 1.5 2e-3\nd 0.5\nnewmtl b\nKd 1 1 1\nTr 0.5\n");
  writeAll(folder / "p.rfl", "400 0.25\n555.5 0.75\n700 0.5\n");
  for (const auto& [name, bytes] : scenes) writeAll(folder / name, bytes);
  writeAll(folder / "s.glb", glb());
  radiosity::writeVtu(
      folder / "s.vtu",
      {.positions = {{0.5, 0, 0}, {1.25, 0, 0}, {1.25, 1.5, 0}}, .corners = {{0}, {1}, {2}}, .polygons = {{0, 3}}}, {});
  for (const char* name : {"s.obj", "s.stl", "s.ply", "s.vtk", "s.vs3", "s.glb", "s.vtu"})
    text += std::string(name) + ": " + numbersOf(radiosity::loadScene(folder / name, {.maxReflectance = 0.875})) + '\n';

  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  fs::create_directories(folder / "vector");
  reference::writeVector(folder / "vector", suite.front(), reference::render(suite.front()));
  text += raster::toText(reference::readVector(folder / "vector").faces.front().face.nearDistance) + '\n';
  text += raster::toText(reference::parseProfile(R"({"vertex_error": 0.125})").vertexError) + '\n';

  const std::vector<double> areas(1500, 0.5), values{0.125, 1e-7};
  const std::vector<std::uint32_t> columns{1300, 1500};
  for (const char* name : {"m.npz", "m.mtx", "m.csv"}) {
    const auto writer = reference::matrixSink(folder / name, {areas});
    for (std::size_t row = 0; row < areas.size(); ++row) {
      writer->write(row == 1200 ? reference::SparseRow{columns, values} : reference::SparseRow{});
    }
    writer->finish();
    for (const double value : reference::readMatrix(folder / name).matrix.value) text += raster::toText(value) + ' ';
  }
  return text + raster::shortNumber(1234.5678) + ' ' + raster::shortNumber(0.125);
}

/// The bytes of all files in a folder.
std::map<std::string, std::string> filesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = readAll(entry.path());
  return files;
}

}  // namespace

TEST_CASE("Readers and writers of all formats ignore the locale", "[locale]") {
  const TemporaryFolder plain, german;
  const std::string expected = exchanged(plain.path);
  std::string found;
  {
    const CommaLocale commas;
    std::ostringstream probe;
    probe << 1234.5;
    CHECK(probe.str() == "1.234,5");
    if (!CommaLocale::ofC()) WARN("no C locale with decimal commas can be made; only that of C++ is tested");
    found = exchanged(german.path);
  }
  CHECK(found == expected);
  CHECK_THAT(expected, Catch::Contains("1.25 ") && Catch::Contains("lowered to 0.875"));
  CHECK(filesOf(german.path) == filesOf(plain.path));
}

TEST_CASE("No source reads or writes numbers by functions that know the locale", "[locale]") {
  std::vector<std::string> functions{"strtod(", "strtof(", "strtold(", "stod(", "stof(", "stold(",
                                     "atof(",   "scanf(",  "%f",       "%g",    "%e",    "%.*"};
  for (char digit = '0'; digit <= '9'; ++digit) functions.push_back(std::string("%.") + digit);
  for (const char* top : {"raster", "radiosity", "reference", "cli", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HEMITEX_SOURCE) / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string text = readAll(entry.path());
      for (const std::string& function : functions) {
        CAPTURE(entry.path(), function);
        CHECK(text.find(function) == std::string::npos);
      }
    }
}
