#include "radiosity/bands/band_textures.h"

#include <algorithm>
#include <cstddef>

#include "radiosity/images/image.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {

std::string bandName(double wavelength) { return "b_" + raster::toText(wavelength); }

void writeBandTextures(const std::filesystem::path& folder, const Discretization& discretization,
                       const TextureLayout& layout, const Solution& solution, const std::vector<double>& wavelengths) {
  const std::vector<Image> inColour = radiosityTextures(discretization, layout, solution.radiosity);
  // Textures have three channels, so that those of three bands are made at a time.
  std::vector<std::vector<Image>> ofBands;
  const BandTable& radiosity = solution.radiosityInBands;
  for (std::size_t first = 0; first < wavelengths.size(); first += 3) {
    std::vector<glm::dvec3> values(radiosity.size());
    for (std::size_t e = 0; e < values.size(); ++e)
      for (std::size_t band = first; band < std::min(first + 3, wavelengths.size()); ++band)
        values[e][static_cast<int>(band - first)] = radiosity[e][band];
    ofBands.push_back(radiosityTextures(discretization, layout, values));
  }
  std::vector<std::string> names{"R", "G", "B"};
  for (std::size_t band = wavelengths.size(); band-- > 0;) names.push_back(bandName(wavelengths[band]));
  for (std::size_t t = 0; t < inColour.size(); ++t) {
    ChannelImage image{inColour[t].width, inColour[t].height, names, {}};
    image.values.reserve(names.size() * inColour[t].pixels.size());
    for (std::size_t pixel = 0; pixel < inColour[t].pixels.size(); ++pixel) {
      for (int channel = 0; channel < 3; ++channel) image.values.push_back(inColour[t].pixels[pixel][channel]);
      for (std::size_t band = wavelengths.size(); band-- > 0;)
        image.values.push_back(ofBands[band / 3][t].pixels[pixel][static_cast<int>(band % 3)]);
    }
    writeExr(folder / (layout.names[t] + ".exr"), image);
  }
}

}  // namespace hemitex::radiosity
