#include "cli/scene/scene_hash.h"

#include <optional>

#include "radiosity/base/bytes.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

/// Collects values for a hash.
struct Bytes {
  std::string text;

  void add(const std::string& value) {
    add(value.size());
    text += value;
  }
  template <typename Value>
  void add(const Value& value) {
    radiosity::appendBytes(text, value);
  }
  template <typename Value>
  void add(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
};

void add(Bytes& bytes, const radiosity::Triangle& triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    bytes.add(triangle.position[k]);
    bytes.add(triangle.chart[k]);
    bytes.add(triangle.texcoord[k]);
  }
  bytes.add(triangle.polygon);
}

void add(Bytes& bytes, const radiosity::Material& material) {
  bytes.add(material.reflectance);
  bytes.add(material.emission);
  bytes.add(material.reflectanceMap);
  bytes.add(material.emissionMap);
}

}  // namespace

std::string hashOf(const radiosity::Scene& scene) {
  std::string hash;
  const auto extend = [&hash](const Bytes& bytes) { hash = reference::sha256(hash + bytes.text); };
  Bytes light;
  light.add(scene.outside.sky);
  for (const radiosity::Sun& sun : scene.outside.suns) {
    light.add(sun.towards);
    light.add(sun.irradiance);
  }
  for (const radiosity::Material& material : scene.materials) add(light, material);
  extend(light);
  for (const radiosity::Image& image : scene.images) {
    Bytes bytes;
    bytes.add(image.width);
    bytes.add(image.height);
    for (const glm::dvec3& pixel : image.pixels) bytes.add(pixel);
    extend(bytes);
  }
  for (const radiosity::Surface& surface : scene.surfaces) {
    Bytes bytes;
    bytes.add(surface.name);
    bytes.add(surface.material);
    bytes.add(surface.twin);
    for (const radiosity::Triangle& triangle : surface.triangles) add(bytes, triangle);
    extend(bytes);
  }
  return hash;
}

}  // namespace hemitex::cli
