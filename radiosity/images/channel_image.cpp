#include "radiosity/images/channel_image.h"

#include "radiosity/images/module_calls.h"

namespace hemitex::radiosity {

void writeExr(const std::filesystem::path& file, const ChannelImage& image) {
  ImageSamples samples{image.width, image.height, static_cast<int>(image.channels.size()), {}, {}, image.channels};
  samples.values.reserve(image.values.size());
  for (const double value : image.values) samples.values.push_back(floatOf(value, file));
  writeBytes(file, encode(file, "openexr", "Linear", samples));
}

}  // namespace hemitex::radiosity
