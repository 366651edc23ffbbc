#include "web/bindings/values.h"

#include <exception>

namespace hemitex::web {

using raster::InputError;

Json jsonOf(const Value& value) {
  if (value.isUndefined() || value.isNull()) return Json::object();
  return Json::parse(Value::global("JSON").call<std::string>("stringify", value));
}

Value toValue(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return Value::global("JSON").call<Value>("parse", text);
}

Json toJson(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }

glm::dvec3 vectorOf(const Json& json) {
  if (!json.is_array() || json.size() != 3) throw InputError("a vector does not have three numbers");
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

Value toArrays(const std::vector<raster::ItemBuffer>& buffers) {
  Value arrays = Value::array();
  for (const raster::ItemBuffer& buffer : buffers) arrays.call<void>("push", toArray("Uint32Array", buffer.ids));
  return arrays;
}

std::vector<raster::ItemBuffer> buffersOf(const Value& arrays, const std::vector<raster::Face>& faces) {
  const auto given = emscripten::vecFromJSArray<Value>(arrays);
  if (given.size() != faces.size()) throw InputError("there is not one item buffer per face");
  std::vector<raster::ItemBuffer> buffers(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    buffers[f].resize(faces[f].scissor);
    const auto ids = emscripten::convertJSArrayToNumberVector<raster::ItemId>(given[f]);
    if (ids.size() != buffers[f].ids.size()) throw InputError("an item buffer does not have the size of its face");
    buffers[f].ids = ids;
  }
  return buffers;
}

void rethrowAsError() {
  std::string message = "unknown error";
  try {
    throw;
  } catch (const std::exception& error) {
    message = error.what();
  } catch (...) {
  }
  Value::global("Error").new_(message).throw_();
  std::terminate();
}

}  // namespace hemitex::web
