#include "python/bindings/conformance.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "python/bindings/arrays.h"
#include "python/bindings/renderers.h"
#include "python/bindings/settings.h"
#include "raster/software/software_renderer.h"
#include "reference/conformance/diagnosis/verdict_report.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_profile.h"
#include "reference/conformance/verdict/explanation.h"

namespace hemitex::python {
namespace {

using raster::InputError;
using reference::TestVector;
using namespace py::literals;

std::string jsonText(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

TestVector makeVector(const py::object& name, const py::dict& list, const py::sequence& faces,
                      const std::vector<std::string>& names) {
  std::vector<raster::Face> views;
  for (const py::handle& face : faces) {
    if (!py::isinstance<py::dict>(face)) throw InputError("`faces` is no list of faces");
    views.push_back(faceOf(py::reinterpret_borrow<py::dict>(face)));
  }
  if (views.empty()) throw InputError("`faces` is empty");
  if (!names.empty() && names.size() != views.size()) throw InputError("there is not one name per face");
  return reference::makeVector(python::textOf(name, "name"), "", drawListOf(list), std::move(views), names);
}

py::dict aboutVector(const TestVector& vector) {
  py::list faces, names;
  for (const reference::VectorFace& face : vector.faces) {
    faces.append(toDict(face.face));
    names.append(face.name);
  }
  return py::dict("name"_a = vector.name, "catches"_a = vector.catches, "draw_list"_a = toDict(vector.list),
                  "faces"_a = faces, "face_names"_a = names);
}

py::list toList(std::vector<raster::ItemBuffer> buffers) {
  py::list list;
  for (raster::ItemBuffer& buffer : buffers) list.append(toArray(std::move(buffer)));
  return list;
}

/// The item buffers of a vector by a rasterizer of Python, or by the reference.
py::list drawVector(const TestVector& vector, const py::object& makeRenderer) {
  const radiosity::RendererFactory make = rendererFactory(makeRenderer);
  return toList(unlocked([&] {
    const auto renderer = make(vector.list);
    return raster::render(*renderer, reference::facesOf(vector));
  }));
}

/// The report as the text of JSON, and per face the verdicts of pixels and the expected item IDs.
py::tuple judgeVector(const TestVector& vector, const py::sequence& found, const py::object& profile) {
  std::vector<raster::ItemBuffer> buffers;
  if (found.size() != vector.faces.size())
    throw InputError("`found` has " + std::to_string(found.size()) + " item buffers; the vector has " +
                     std::to_string(vector.faces.size()) + " faces");
  for (std::size_t f = 0; f < vector.faces.size(); ++f)
    buffers.push_back(itemBufferOf(py::object(found[f]), vector.faces[f].face, vector.list.format,
                                   "found[" + std::to_string(f) + "]"));
  const reference::DeviceProfile allowed =
      profile.is_none() ? reference::DeviceProfile() : reference::parseProfile(python::textOf(profile, "profile"));
  reference::Report report = unlocked([&] { return reference::reportOn(vector, buffers, allowed); });
  py::list pixels, expected;
  for (reference::FaceVerdict& face : report.verdict.faces) {
    std::vector<std::uint8_t> verdicts;
    for (const reference::PixelVerdict verdict : face.pixels) verdicts.push_back(static_cast<std::uint8_t>(verdict));
    pixels.append(toArray(std::move(verdicts), {face.expected.height, face.expected.width}));
    expected.append(toArray(face.expected));
  }
  return py::make_tuple(jsonText(reference::toJson(report)), toText(report.findings), pixels, expected);
}

std::string explainPixel(const TestVector& vector, const py::object& name, const py::object& column,
                         const py::object& row) {
  const std::string wanted = python::textOf(name, "face");
  const int x = static_cast<int>(integerOf(column, "column", -1, 4096));
  const int y = static_cast<int>(integerOf(row, "row", -1, 4096));
  std::string known;
  for (const reference::VectorFace& face : vector.faces) {
    if (face.name == wanted) return jsonText(unlocked([&] { return reference::explanation(vector, face, x, y); }));
    known += (known.empty() ? "" : ", ") + face.name;
  }
  throw InputError("the vector has no face `" + raster::excerpt(wanted) + "`", "it has " + known);
}

}  // namespace

void addConformance(py::module_& module) {
  py::class_<TestVector>(module, "TestVector");
  module.def("vector_suite", [] { return unlocked([] { return reference::vectorSuite(); }); });
  module.def("read_vector", [](const std::filesystem::path& folder) {
    return unlocked([&] { return reference::readVector(folder); });
  });
  module.def("write_vector", [](const TestVector& vector, const std::filesystem::path& folder) {
    unlocked([&] { reference::writeVector(folder, vector, reference::render(vector)); });
  });
  module.def("make_vector", &makeVector);
  module.def("about_vector", &aboutVector);
  module.def("draw", &drawVector);
  module.def("judge", &judgeVector);
  module.def("explain", &explainPixel);
}

}  // namespace hemitex::python
