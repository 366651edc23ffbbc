#include "radiosity/images/image_module.h"

#include "radiosity/base/module_symbol.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {

namespace {

/// Throws InputError if a limit of the address space leaves too little for the libraries of the module.
void requireSpaceForImages() {
  // Where the libraries behind OpenImageIO, 430 MB when measured, lack address space, some crash or hang.
  constexpr std::uint64_t needed = std::uint64_t{480} << 20;
  const std::uint64_t available = raster::freeAddressSpace();
  if (available < needed)
    throw raster::InputError("the libraries for images take up to " + raster::memoryText(needed) +
                                 " of address space; " + raster::memoryText(available) + " are free",
                             "raise the limit (ulimit -v)");
}

}  // namespace

const ImageFunctions& imageFunctions() {
  static const void* const functions = [] {
    requireSpaceForImages();
    return moduleSymbol("hemitex_images.so", "hemitexImageFunctions");
  }();
  return *static_cast<const ImageFunctions*>(functions);
}

const ImageEncoders& imageEncoders() {
  static const void* const encoders = moduleSymbol("hemitex_image_encoders.so", "hemitexImageEncoders");
  return *static_cast<const ImageEncoders*>(encoders);
}

}  // namespace hemitex::radiosity
