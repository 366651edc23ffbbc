/// Modules: shared libraries that programs open when they first need them.
#pragma once

namespace hemitex::radiosity {

/// The address of a symbol that a module exports, such as `hemitexImageFunctions` of "hemitex_images.so". The module
/// stays open until the program ends. Throws std::runtime_error where the module or the symbol is not found.
const void* moduleSymbol(const char* module, const char* symbol);

}  // namespace hemitex::radiosity
