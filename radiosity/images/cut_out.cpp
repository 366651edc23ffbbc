#include "radiosity/images/cut_out.h"

#include <cmath>
#include <cstdint>

namespace hemitex::radiosity {

CutOut cutOutOf(const Image& image, double factor, double cutoff) {
  CutOut cutOut{image.width, image.height, {}, image.sampler};
  for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel)
    cutOut.isHole.push_back(factor * (image.alpha.empty() ? 1.0 : static_cast<double>(image.alpha[pixel])) < cutoff);
  return cutOut;
}

bool isHoleAt(const CutOut& cutOut, const glm::dvec2& texcoord) {
  const glm::dvec2 place = nearPlace(cutOut.sampler(texcoord), cutOut.sampler.wrap);
  const auto cell = [](double along, int size) { return static_cast<std::int64_t>(std::floor(along * size)); };
  return cutOut.isHole[wrappedPixel(cutOut.width, cutOut.height, cutOut.sampler.wrap, cell(place.x, cutOut.width),
                                    cell(place.y, cutOut.height))];
}

}  // namespace hemitex::radiosity
