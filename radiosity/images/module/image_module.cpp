#include "radiosity/images/image_module.h"

#include "radiosity/base/module_symbol.h"

namespace hemitex::radiosity {

const ImageFunctions& imageFunctions() {
  static const void* const functions = moduleSymbol("hemitex_images.so", "hemitexImageFunctions");
  return *static_cast<const ImageFunctions*>(functions);
}

}  // namespace hemitex::radiosity
