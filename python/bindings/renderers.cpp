#include "python/bindings/renderers.h"

#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <utility>

#include "python/bindings/arrays.h"
#include "python/bindings/settings.h"
#include "reference/devices/choice/judged_device.h"

namespace hemitex::python {
namespace {

using raster::InputError;
using namespace py::literals;

constexpr std::int64_t largestId = std::numeric_limits<std::uint32_t>::max();

template <typename Value>
using Names = std::vector<std::pair<std::string, Value>>;

const Names<raster::Blend>& blends() {
  static const Names<raster::Blend> names{{"clamped-add", raster::Blend::ClampedAdd},
                                          {"integer-add", raster::Blend::IntegerAdd},
                                          {"replace", raster::Blend::Replace}};
  return names;
}

const Names<raster::Cull>& culls() {
  static const Names<raster::Cull> names{
      {"none", raster::Cull::None}, {"front", raster::Cull::Front}, {"back", raster::Cull::Back}};
  return names;
}

const Names<raster::PixelValue>& pixelValues() {
  static const Names<raster::PixelValue> names{{"item-ids", raster::PixelValue::ItemIds},
                                               {"triangle-numbers", raster::PixelValue::TriangleNumbers}};
  return names;
}

template <typename Value>
std::string nameOf(const Names<Value>& names, Value value) {
  for (const auto& [name, each] : names)
    if (each == value) return name;
  return {};
}

/// Vectors of binary32 as an array.
template <typename Vector>
py::array_t<float> floats(const std::vector<Vector>& vectors) {
  std::vector<float> values;
  for (const Vector& vector : vectors)
    for (int axis = 0; axis < Vector::length(); ++axis) values.push_back(vector[axis]);
  return toArray(std::move(values), {static_cast<py::ssize_t>(vectors.size()), Vector::length()});
}

template <typename Vector>
std::vector<Vector> floatVectors(const py::handle& argument, const std::string& name) {
  const Array<double> array = numbers(argument, name, {-1, Vector::length()});
  std::vector<Vector> vectors(array.length(), Vector(0));
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    const auto value = static_cast<float>(array.values[i]);
    if (!std::isfinite(value)) throw InputError("`" + name + "` has a number beyond the range of binary32");
    vectors[i / static_cast<std::size_t>(Vector::length())][static_cast<int>(i) % Vector::length()] = value;
  }
  return vectors;
}

py::object member(const py::dict& dictionary, const char* name) {
  if (!dictionary.contains(name)) throw InputError("`" + std::string(name) + "` is missing");
  return dictionary[name];
}

std::uint32_t numberOf(const py::handle& value, const std::string& name) {
  return static_cast<std::uint32_t>(integerOf(value, name, 0, largestId));
}

py::dict toDict(const raster::Draw& draw) {
  return py::dict("first"_a = draw.first / 3, "count"_a = draw.count / 3, "offset"_a = draw.offset,
                  "back"_a = draw.back, "index_map"_a = draw.indexMap, "cull"_a = nameOf(culls(), draw.cull));
}

raster::Draw drawOf(const py::dict& dictionary) {
  constexpr std::int64_t maxTriangles = largestId / 3;
  raster::Draw draw;
  draw.first = 3 * static_cast<std::uint32_t>(integerOf(member(dictionary, "first"), "first", 0, maxTriangles));
  draw.count = 3 * static_cast<std::uint32_t>(integerOf(member(dictionary, "count"), "count", 0, maxTriangles));
  draw.offset = numberOf(member(dictionary, "offset"), "offset");
  if (const py::object back = member(dictionary, "back"); !back.is_none()) draw.back = numberOf(back, "back");
  if (const py::object map = member(dictionary, "index_map"); !map.is_none())
    draw.indexMap = static_cast<int>(integerOf(map, "index_map", 0, std::numeric_limits<int>::max()));
  assign(draw.cull, Settings(dictionary).choice("cull", culls()));
  return draw;
}

/// A rasterizer of Python.
class PythonRenderer final : public raster::ItemBufferRenderer {
 public:
  PythonRenderer(const raster::DrawList& list, const py::object& make)
      : format_(list.format), draw_(keep(make(python::toDict(list)))) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    buffers.resize(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
      {
        const py::gil_scoped_acquire locked;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        const py::object ids =
            (*draw_)(python::toDict(faces[f]), toArray(std::vector<std::uint32_t>(skipped.begin(), skipped.end())));
        buffers[f] = itemBufferOf(ids, faces[f], format_, "the result of the rasterizer");
      }
      drawn(f);
    }
  }

 private:
  raster::IdFormat format_;
  Kept draw_;
};

/// The renderers of a device, by its name of `--device`. Another build of this module judges the device anew.
radiosity::RendererFactory deviceRenderers(const std::string& name) {
  const auto device = Settings(py::dict("rasterizer"_a = name)).choice("rasterizer", reference::rowDevices());
  const auto module = py::module_::import("hemitex._core").attr("__file__").cast<std::string>();
  return unlocked([&] { return reference::judgedRenderers({*device}, module, [](const std::string&) {}); });
}

}  // namespace

py::dict toDict(const raster::DrawList& list) {
  raster::requireUsual(list);
  py::list draws, maps;
  for (const raster::Draw& draw : list.draws) draws.append(toDict(draw));
  for (const raster::IndexMap& map : list.indexMaps) maps.append(toArray(map.ids, {map.height, map.width}));
  return py::dict(
      "positions"_a = floats(list.positions), "texcoords"_a = floats(list.texcoords),
      "triangles"_a = toArray(list.indices, {static_cast<py::ssize_t>(list.indices.size() / 3), py::ssize_t{3}}),
      "draws"_a = draws, "index_maps"_a = maps, "channel_bits"_a = py::tuple(py::cast(list.format.channelBits)),
      "blend"_a = nameOf(blends(), list.blend), "values"_a = nameOf(pixelValues(), list.value));
}

raster::DrawList drawListOf(const py::dict& dictionary) {
  raster::DrawList list;
  list.positions = floatVectors<glm::vec3>(member(dictionary, "positions"), "positions");
  list.texcoords = floatVectors<glm::vec2>(member(dictionary, "texcoords"), "texcoords");
  const Array<std::int64_t> triangles = integers(member(dictionary, "triangles"), "triangles", {-1, 3}, 0, largestId);
  if (triangles.values.size() > static_cast<std::size_t>(largestId))
    throw InputError("`triangles` has more than 2^32 indices");
  for (const std::int64_t index : triangles.values) list.indices.push_back(static_cast<std::uint32_t>(index));
  for (const py::handle& each : member(dictionary, "index_maps")) {
    const Array<std::int64_t> map = integers(each, "index_maps", {-1, -1}, 0, largestId);
    if (map.shape[0] > std::numeric_limits<int>::max() || map.shape[1] > std::numeric_limits<int>::max())
      throw InputError("`index_maps` has a side of more than 2^31 texels");
    list.indexMaps.push_back({static_cast<int>(map.shape[1]), static_cast<int>(map.shape[0]), {}});
    for (const std::int64_t id : map.values) list.indexMaps.back().ids.push_back(static_cast<std::uint32_t>(id));
  }
  for (const py::handle& each : member(dictionary, "draws")) {
    if (!py::isinstance<py::dict>(each)) throw InputError("`draws` is no list of draws");
    list.draws.push_back(drawOf(py::reinterpret_borrow<py::dict>(each)));
  }
  const Array<std::int64_t> bits = integers(member(dictionary, "channel_bits"), "channel_bits", {-1}, 1, 32);
  if (bits.length() > 32) throw InputError("`channel_bits` has more than 32 channels");
  list.format.channelBits.clear();
  for (const std::int64_t width : bits.values) list.format.channelBits.push_back(static_cast<int>(width));
  assign(list.blend, Settings(dictionary).choice("blend", blends()));
  assign(list.value, Settings(dictionary).choice("values", pixelValues()));
  raster::validate(list);
  return list;
}

py::dict toDict(const raster::Face& face) {
  raster::requireUsual(face);
  const auto three = [](const glm::vec3& v) { return py::make_tuple(v.x, v.y, v.z); };
  return py::dict(
      "eye"_a = three(face.eye), "x"_a = three(face.x), "y"_a = three(face.y), "w"_a = three(face.w),
      "near"_a = face.nearDistance, "resolution"_a = face.resolution,
      "scissor"_a = py::make_tuple(face.scissor.column, face.scissor.row, face.scissor.width, face.scissor.height));
}

raster::Face faceOf(const py::dict& dictionary) {
  raster::Face face;
  const auto three = [&](const char* name) { return glm::vec3(vectorOf(member(dictionary, name), name)); };
  face.eye = three("eye");
  face.x = three("x");
  face.y = three("y");
  face.w = three("w");
  const Settings settings(dictionary);
  constexpr double largest = std::numeric_limits<float>::max();
  if (const auto distance = settings.number("near", 0, largest)) face.nearDistance = static_cast<float>(*distance);
  assign(face.resolution, settings.integer("resolution", 2, 4096));
  const Array<std::int64_t> scissor = integers(member(dictionary, "scissor"), "scissor", {4}, 0, 4096);
  const auto side = [&](std::size_t i) { return static_cast<int>(scissor.values[i]); };
  face.scissor = {side(0), side(1), side(2), side(3)};
  raster::validate(face);
  return face;
}

py::object toArray(raster::ItemBuffer buffer) {
  return python::toArray(std::move(buffer.ids), {buffer.height, buffer.width});
}

raster::ItemBuffer itemBufferOf(const py::handle& array, const raster::Face& face, const raster::IdFormat& format,
                                const std::string& name) {
  const Array<std::int64_t> ids = integers(array, name, {face.scissor.height, face.scissor.width}, 0,
                                           static_cast<std::int64_t>(raster::backgroundId(format)));
  raster::ItemBuffer buffer;
  buffer.resize(face.scissor);
  for (std::size_t i = 0; i < ids.values.size(); ++i) buffer.ids[i] = static_cast<raster::ItemId>(ids.values[i]);
  return buffer;
}

radiosity::RendererFactory rendererFactory(py::object make) {
  if (make.is_none()) return radiosity::softwareRenderer;
  if (py::isinstance<py::str>(make)) return deviceRenderers(make.cast<std::string>());
  return [kept = keep(std::move(make))](const raster::DrawList& list) -> std::unique_ptr<raster::ItemBufferRenderer> {
    const py::gil_scoped_acquire locked;
    return std::make_unique<PythonRenderer>(list, *kept);
  };
}

}  // namespace hemitex::python
