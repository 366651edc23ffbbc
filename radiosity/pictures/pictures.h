/// Pictures of a scene, unlit as in an OBJ viewer, and of the borders of its polygons and elements. All have width x
/// height pixels and throw InputError as drawPicture.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The element that contains a visible point.
std::uint32_t elementAt(const Scene& scene, const Discretization& discretization, const Visible& visible);

/// The linear colour of the visible point of a sample. Several threads call it.
using ColourOf = std::function<glm::dvec3(const Visible&)>;

/// A picture with 2 x 2 samples per pixel, averaged in linear light; 16 samples in eight rows and eight columns where
/// the pixel, or it and one beside it, show several surfaces, a fold of one, or a part of one in front of another.
/// Samples without a surface have the colour `background`. Throws InputError for sides above 2048 pixels, and as
/// cameraFace.
Image drawPicture(const Scene& scene, const Camera& camera, int width, int height, const ColourOf& colourOf,
                  const glm::dvec3& background = glm::dvec3(0.0));

/// The background of a lit picture: the sky as a surface of its radiance would show, whose radiosity equals the
/// irradiance `sky`; at most 1, as texels are, so that the edges of a window stay smooth. Suns have no extent and do
/// not show.
glm::dvec3 skyColour(const glm::dvec3& sky, double exposure);

/// The colour in a viewer without lights: Kd times map_Kd, bilinear between texel centres, times the interpolated
/// colours of the corners.
glm::dvec3 unlitColour(const Scene& scene, const Visible& visible);
/// As above with maps that are not in the scene: `mapColour` gives the linear colour of a map at (u, v).
using MapColour = std::function<glm::dvec3(std::size_t map, const glm::dvec2& uv)>;
glm::dvec3 unlitColour(const Scene& scene, const Visible& visible, const MapColour& mapColour);

/// The scene in its unlit colours; for a solved scene (see writeLitScene) that is its light.
Image unlitPicture(const Scene& scene, const Camera& camera, int width, int height,
                   const glm::dvec3& background = glm::dvec3(0.0));

/// One value per element, without filtering: a solution after a one-to-one mapping (Figure 3).
Image elementPicture(const Scene& scene, const Discretization& discretization, const ElementValues& values,
                     const Camera& camera, int width, int height, const glm::dvec3& background = glm::dvec3(0.0));

/// Figure 2 (d): the borders of the file's polygons, hidden lines removed, black on white.
Image wireframePicture(const Scene& scene, const Camera& camera, int width, int height);
/// Figure 2 (e): as above with the borders of elements, where regular meshing would cut the polygons.
Image meshPicture(const Scene& scene, const Discretization& discretization, const Camera& camera, int width,
                  int height);

}  // namespace hemitex::radiosity
