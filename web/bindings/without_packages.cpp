/// What hemitex has from packages that the page lacks. Images, glTF and VTK's XML files are refused, and the page
/// computes SHA-256.
#include <stdexcept>

#include "radiosity/base/module_symbol.h"
#include "radiosity/meshes/mesh_formats.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "web/bindings/values.h"

namespace hemitex {

const void* radiosity::moduleSymbol(const char* module, const char*) {
  throw std::runtime_error(std::string("the page has no ") + module);
}

radiosity::PolygonMesh radiosity::parseVtkXml(std::string_view, const std::filesystem::path& file,
                                              std::span<const std::string>) {
  throw raster::InputError(file.string(), 0, "is a VTK file, which the page cannot read");
}

/// The module's function `sha256` takes bytes and returns digits.
std::string reference::sha256(std::string_view bytes) {
  const auto view = emscripten::typed_memory_view(bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  return web::Value::module_property("sha256")(view).as<std::string>();
}

std::string reference::sha256OfFile(const std::filesystem::path& file) { return sha256(raster::readFile(file)); }

}  // namespace hemitex
