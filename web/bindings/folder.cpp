#include "web/bindings/folder.h"

#include <cstdint>

#include "raster/base/file_io.h"

namespace hemitex::web {
namespace {

const std::filesystem::path parent = "/files";

std::string bytesOf(const Value& content) {
  if (content.isString()) return content.as<std::string>();
  const auto bytes = emscripten::convertJSArrayToNumberVector<std::uint8_t>(content);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Folder::Folder(const std::string& name) : path_(parent / name) { std::filesystem::create_directories(path_); }

Folder::Folder(const Value& files) : Folder() {
  const Value names = Value::global("Object").call<Value>("keys", files);
  for (const std::string& name : emscripten::vecFromJSArray<std::string>(names))
    raster::writeFile(path_ / name, bytesOf(files[name]));
}

Folder::~Folder() { std::filesystem::remove_all(parent); }

}  // namespace hemitex::web
