#include "radiosity/base/module_symbol.h"

#include <dlfcn.h>

#include <new>
#include <stdexcept>
#include <string>

namespace hemitex::radiosity {

const void* moduleSymbol(const char* module, const char* symbol) {
  // Without a folder in the name, the dynamic linker searches the run path that CMake gives every program that links
  // hemitex::radiosity.
  void* const handle = dlopen(module, RTLD_NOW | RTLD_LOCAL);
  const void* const address = handle ? dlsym(handle, symbol) : nullptr;
  if (address) return address;
  const std::string problem = dlerror();
  for (const char* lack : {"failed to map segment", "annot allocate memory"})
    if (problem.find(lack) != problem.npos) throw std::bad_alloc();
  throw std::runtime_error(problem);
}

}  // namespace hemitex::radiosity
