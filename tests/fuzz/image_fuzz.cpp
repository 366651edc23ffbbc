// Images: PNG and JPEG in memory as in glTF files, EXR as a file. Those of more than 2^16 pixels are refused, so
// that a run takes little time and memory.
#include <array>

#include "radiosity/images/image_module.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

namespace {

bool isExr(const std::uint8_t* data, std::size_t size) {
  constexpr std::array<std::uint8_t, 4> magic{0x76, 0x2f, 0x31, 0x01};
  return size >= magic.size() && std::equal(magic.begin(), magic.end(), data);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("image.exr");
  constexpr std::uint64_t maxPixels = 1u << 16;
  const auto ignore = [](const radiosity::ImageSamples&, int) {};
  const auto& images = radiosity::imageFunctions();
  const auto problem = isExr(data, size) ? images.read(file.write(data, size).string(), maxPixels, ignore)
                                         : images.decode({data, data + size}, maxPixels, ignore);
  fuzz::countOutcome(problem.problem);
  return 0;
}
