#include "radiosity/images/image_module.h"

#include <dlfcn.h>

#include <stdexcept>

namespace hemitex::radiosity {
namespace {

const ImageFunctions& openModule() {
  // Without a folder in the name, the dynamic linker searches the run path that CMake gives every program that links
  // hemitex::radiosity. The module stays open until the program ends.
  void* const module = dlopen("hemitex_images.so", RTLD_NOW | RTLD_LOCAL);
  const void* const functions = module ? dlsym(module, "hemitexImageFunctions") : nullptr;
  if (!functions) throw std::runtime_error(dlerror());
  return *static_cast<const ImageFunctions*>(functions);
}

}  // namespace

const ImageFunctions& imageFunctions() {
  static const ImageFunctions& functions = openModule();
  return functions;
}

}  // namespace hemitex::radiosity
