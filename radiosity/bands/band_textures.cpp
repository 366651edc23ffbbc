#include "radiosity/bands/band_textures.h"

#include <cstddef>

#include "radiosity/images/image.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {

std::string bandName(double wavelength) { return "b_" + raster::toText(wavelength); }

void writeBandTextures(const std::filesystem::path& folder, const Discretization& discretization,
                       const TextureLayout& layout, const BandSolution& bands, const std::vector<glm::dvec3>& colours) {
  const std::vector<Image> inColour = radiosityTextures(discretization, layout, colours);
  std::vector<std::vector<Image>> ofGroups;
  for (const Solution& group : bands.groups)
    ofGroups.push_back(radiosityTextures(discretization, layout, group.radiosity));
  std::vector<std::string> names{"R", "G", "B"};
  for (const double wavelength : bands.wavelengths) names.push_back(bandName(wavelength));
  for (std::size_t t = 0; t < inColour.size(); ++t) {
    ChannelImage image{inColour[t].width, inColour[t].height, names, {}};
    image.values.reserve(names.size() * inColour[t].pixels.size());
    for (std::size_t pixel = 0; pixel < inColour[t].pixels.size(); ++pixel) {
      for (int channel = 0; channel < 3; ++channel) image.values.push_back(inColour[t].pixels[pixel][channel]);
      for (std::size_t band = 0; band < bands.wavelengths.size(); ++band) {
        const BandPlace at = placeOf(band, bands.wavelengths.size());
        image.values.push_back(ofGroups[at.group][t].pixels[pixel][at.place]);
      }
    }
    writeExr(folder / (layout.names[t] + ".exr"), image);
  }
}

}  // namespace hemitex::radiosity
