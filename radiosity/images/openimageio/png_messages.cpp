/// libpng prints an error on stderr if the function that OpenImageIO gives it for errors returns, and it does. This
/// definition of png_set_error_fn comes before that of libpng when the module hemitex_images is opened.
#include <dlfcn.h>
#include <png.h>

namespace {

/// The function of OpenImageIO notes the message. The jump ends the call of libpng, as its own function would after
/// printing.
[[noreturn]] void noteAndStop(png_structp image, png_const_charp message) {
  reinterpret_cast<png_error_ptr>(png_get_user_transform_ptr(image))(image, message);
  png_longjmp(image, 1);
}

void ignore(png_structp, png_const_charp) {}

}  // namespace

extern "C" __attribute__((visibility("default"))) void png_set_error_fn(png_structrp image, png_voidp data,
                                                                        png_error_ptr error, png_error_ptr warning) {
  static const auto set = reinterpret_cast<decltype(&png_set_error_fn)>(dlsym(RTLD_NEXT, "png_set_error_fn"));
  // Transforms of users have a place for their data, which OpenImageIO does not use.
  png_set_user_transform_info(image, reinterpret_cast<png_voidp>(error ? error : ignore), 0, 0);
  set(image, data, noteAndStop, warning ? warning : ignore);
}
