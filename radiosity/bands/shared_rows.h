/// Solutions of the same elements with other materials and light, such as those of groups of bands. Form factors do not
/// depend on either, so that all solutions use the same patches and rows.
///
/// Neighbouring bands have similar light. So each solution but the first starts from a guess: each patch that shot
/// before shoots the flux that its elements send out if they receive the same share of the emitted flux as before. This
/// takes one pass over the rows, without a choice of patches. The rest, of either sign, is shot until the residual is
/// reached (see shooting_state.h), which bounds the error as it does without a guess.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::radiosity {

/// The input of a solution, without its patches. It may change the scene and the discretization that inputs refer to,
/// but neither the surfaces nor the elements.
using InputOf = std::function<SolveInput(std::size_t solution)>;

/// `count` solutions, at least one, in this order. Each goes on with the patches as the one before split them, and
/// splits those that did not shoot before. So the first decides how the brightest patches are split. The rows of all
/// take at most the memory of one: that of the first input's settings. The first solution has the bits of `solve`. Each
/// counts its own shots, without the guess. The last one has the patches. After `progress` returned false, each of the
/// following ends after its first shot.
std::vector<Solution> solveWithSameRows(std::size_t count, Patches patches, const InputOf& inputOf,
                                        const Progress& progress = {});

}  // namespace hemitex::radiosity
