/// Light that arrives at points of surfaces straight from lamps and suns: what arrives if nothing is in between, in
/// closed form, times the visible share, by rays. A lamp that is a surface is a polygon with a form factor
/// (convex_part.h). Elements would show it with the edges of pixels, and its shadow with those of elements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "radiosity/base/bands.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A part of a surface around a point that is lit as one.
struct LitPlace {
  std::uint32_t surface = 0;
  SurfacePoint point;
  /// The sides of a parallelogram around the point, over which the visible share is the mean; 0: at the point alone.
  glm::dvec3 along1{0.0}, along2{0.0};
};

class DirectLight {
 public:
  /// Rays from a place to a source of light.
  static constexpr std::uint32_t maxRays = 64;

  /// The sources are suns, lamps that are points, and planar emitting faces without maps: those of the surfaces with
  /// the largest flux, while there are at most 64 faces with images. The arguments must outlive this object.
  DirectLight(const Scene& scene, const Discretization& discretization);

  /// Whether the emission of a surface is among the sources.
  bool hasEmissionOf(std::uint32_t surface) const { return areSources_[surface]; }
  std::size_t count() const { return sources_.size(); }
  /// The light of a source: its irradiance in W/m^2 where the factor and the visible share are 1.
  std::span<const double> light(std::size_t source) const { return sources_[source].light; }
  /// The factor of the irradiance at a point that sees all of the source; 0 behind the horizon.
  double factor(std::size_t source, const SurfacePoint& point) const;
  /// The visible share of a source in [0, 1], by rays, weighted by the light along each. Their number is a power of two
  /// up to maxRays, so that they are spread evenly.
  double visibleShare(std::size_t source, const LitPlace& place, std::uint32_t rays = maxRays) const;
  /// The same by few rays, among them those from the corners of the place and those to the corners of the source, at
  /// which a shadow begins. 0 and 1 mean that probably nothing of it is visible, or all.
  double probedShare(std::size_t source, const LitPlace& place) const;

 private:
  /// A sun has `towards`, a lamp a point, and a face triangles with points.
  struct Source {
    Bands light;
    std::vector<std::array<glm::dvec3, 3>> triangles = {};
    glm::dvec3 normal{0.0};               ///< of the triangles
    std::vector<glm::dvec3> points = {};  ///< maxRays of a face
    std::vector<glm::dvec3> corners = {};
    std::optional<LampCone> cone = {};
    glm::dvec3 towards{0.0};
  };

  struct Seen {
    double seen = 0, all = 0;
    double share() const { return all > 0 ? seen / all : 0; }
  };

  /// Adds the ray from a point of a place, in its sides from the middle, to a point of a source.
  void addRay(const Source& source, const LitPlace& place, const glm::dvec2& at, const glm::dvec3& to, Seen& sum) const;
  /// The point of a source for ray k.
  static const glm::dvec3& pointOfRay(const Source& source, std::uint32_t k);
  void addSuns();
  void addLamps();
  void addFaces();
  std::vector<Source> facesOf(std::uint32_t surface) const;

  const Scene& scene_;
  const Discretization& discretization_;
  RayTree rays_;
  double height_;  ///< of points of faces over these, so that rays end in front of them
  std::vector<Source> sources_;
  std::vector<bool> areSources_;  ///< one per surface
};

}  // namespace hemitex::radiosity
