#include "radiosity/base/module_symbol.h"

#include <dlfcn.h>

#include <stdexcept>

namespace hemitex::radiosity {

const void* moduleSymbol(const char* module, const char* symbol) {
  // Without a folder in the name, the dynamic linker searches the run path that CMake gives every program that links
  // hemitex::radiosity.
  void* const handle = dlopen(module, RTLD_NOW | RTLD_LOCAL);
  const void* const address = handle ? dlsym(handle, symbol) : nullptr;
  if (!address) throw std::runtime_error(dlerror());
  return address;
}

}  // namespace hemitex::radiosity
