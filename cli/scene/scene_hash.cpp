#include "cli/scene/scene_hash.h"

#include <optional>

#include "radiosity/base/bytes.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

/// Collects values for a hash.
struct Bytes {
  std::string text;

  template <typename... Values>
  void add(const Values&... values) {
    (append(values), ...);
  }

 private:
  void append(const std::string& value) {
    append(value.size());
    text += value;
  }
  template <typename Value>
  void append(const Value& value) {
    radiosity::appendBytes(text, value);
  }
  template <typename Value>
  void append(const std::optional<Value>& value) {
    append(value.has_value());
    if (value) append(*value);
  }
};

}  // namespace

std::string hashOf(const radiosity::Scene& scene) {
  std::string hash;
  const auto extend = [&hash](const Bytes& bytes) { hash = reference::sha256(hash + bytes.text); };
  Bytes light;
  light.add(scene.outside.sky);
  for (const radiosity::Sun& sun : scene.outside.suns) light.add(sun.towards, sun.irradiance);
  for (const radiosity::Lamp& lamp : scene.lamps) {
    light.add(lamp.name, lamp.position, lamp.intensity, scene.squareMetres);
    if (lamp.cone) light.add(lamp.cone->axis, lamp.cone->innerCosine, lamp.cone->outerCosine);
  }
  for (const radiosity::Material& material : scene.materials)
    light.add(material.reflectance, material.emission, material.reflectanceMap, material.emissionMap);
  for (const radiosity::Material& material : scene.materials) {
    if (!material.cutOut) continue;
    light.add(material.cutOut->width, material.cutOut->height, material.cutOut->sampler.place,
              material.cutOut->sampler.wrap);
    for (const bool isHole : material.cutOut->isHole) light.add(isHole);
  }
  if (!scene.wavelengths.empty()) {
    light.add(scene.wavelengths);
    for (const radiosity::Material& material : scene.materials)
      light.add(reflectanceInBands(scene, material), emissionInBands(scene, material));
  }
  extend(light);
  if (scene.instances.size() > 1) {
    Bytes instances;
    for (const radiosity::Instance& instance : scene.instances) instances.add(instance.sign, instance.shift);
    extend(instances);
  }
  for (const radiosity::Image& image : scene.images) {
    Bytes bytes;
    bytes.add(image.width, image.height);
    if (!(image.sampler == radiosity::Sampler())) bytes.add(image.sampler.place, image.sampler.wrap);
    for (const glm::dvec3& pixel : image.pixels) bytes.add(pixel);
    extend(bytes);
  }
  for (const radiosity::Surface& surface : scene.surfaces) {
    Bytes bytes;
    bytes.add(surface.name, surface.material, surface.twin, surface.curvedPart);
    for (const radiosity::Triangle& triangle : surface.triangles) {
      for (std::size_t k = 0; k < 3; ++k) bytes.add(triangle.position[k], triangle.chart[k], triangle.texcoord[k]);
      if (surface.hasColours) bytes.add(triangle.colour[0], triangle.colour[1], triangle.colour[2]);
      bytes.add(triangle.polygon);
    }
    extend(bytes);
  }
  return hash;
}

}  // namespace hemitex::cli
