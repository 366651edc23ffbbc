/// Evenly spread directions over the whole sphere: the spherical Fibonacci lattice, which integrates light over
/// directions with a smaller error than Sobol points do (Marques, Bouville, Ribardiere, Santos and Bouatouch 2013).
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace hemitex::radiosity {

/// Unit vectors, each for the same solid angle; `count` is at least 1. The bits are equal on all machines.
std::vector<glm::dvec3> sphereDirections(int count);

}  // namespace hemitex::radiosity
