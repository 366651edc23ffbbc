/// What is known of a matrix of form factors that is judged: the places of its facets, and its entries in some rows and
/// columns beside those that rays measure and closed forms bound.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reference/matrices/covered_pairs.h"
#include "reference/matrices/judge_input.h"
#include "reference/matrices/sparse_matrix.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

namespace hemitex::reference {

/// Normal deviations of a confidence of 1 - 1e-6.
inline constexpr double confidence = 4.9;
/// A single entry that differs by less is no fault; the sum of such differences may be one.
inline constexpr double smallestFactor = 5e-4;
/// Differences within this number of standard errors say nothing of a fault.
inline constexpr double unclear = 3;
/// Of all facets, rough rows tell which are measured beside the others.
inline constexpr std::size_t suspects = 6;

/// A matrix, and where the facets of its mesh lie. A place has one surface or several in contact that face the same
/// way; light to it may be divided between their facets and the repetitions of these in any way.
struct JudgedMatrix {
  JudgedMatrix(const SparseMatrix& matrix, const FacetMesh& mesh);

  const SparseMatrix& matrix;
  const FacetMesh& mesh;
  std::vector<double> area;  ///< of the surfaces
  std::vector<CoveredPair> pairs;
  std::vector<bool> touches;                         ///< whether another surface touches the back of each
  std::vector<std::uint32_t> placeOf;                ///< the first surface in the place of each
  std::vector<std::vector<std::uint32_t>> facetsOf;  ///< of the place of each surface that is the first there
  std::vector<double> areaOfPlace;                   ///< of these facets

  std::uint32_t facet(std::uint32_t surface) const { return mesh.facetOf[surface]; }
  std::uint32_t facets() const { return static_cast<std::uint32_t>(mesh.facets); }
  /// Whether the matrix has the columns of surroundings and backs.
  bool hasOutside() const { return matrix.columns > mesh.facets; }
  /// An entry; 0 if the matrix lacks it.
  double entry(std::uint32_t row, std::uint32_t column) const;
  /// The error that the matrix states for an entry whose true value is known; 0 if it states none. Errors of counts
  /// grow with the root of the value, so that a true value above the given one has a larger error. An entry that the
  /// matrix lacks has the error of the smallest one of its row.
  double statedError(std::uint32_t row, std::uint32_t column, double truth) const;
};

inline std::string nameOfFacet(std::uint32_t facet) { return "facet " + std::to_string(facet); }

/// A row by rays, one value per surface. By reciprocity it is also what the surface receives, in units of its own
/// light.
struct TrueRow {
  std::uint32_t surface = 0;
  std::vector<double> factor, error;
  double sum = 0;
  std::array<Measurement, 2> outside{};  ///< surroundings, backs
  double sumError = 0;                   ///< of the sum, at most
};

std::vector<TrueRow> measuredRows(const FacetMesh& mesh, const std::vector<std::uint32_t>& surfaces, int samples);

/// `count` surfaces, or all if there are fewer, evenly spread over their numbers.
std::vector<std::uint32_t> spreadSurfaces(std::size_t surfaces, std::size_t count);

/// The light from a measured facet to the place of a surface; all are 0 unless it is the first there.
struct JudgedEntry {
  double found = 0, truth = 0;
  double stated = 0, measured = 0, error = 0;  ///< errors: of the matrix, of the rays, of both
  double closed = 0;                           ///< the form factor without blockers, which is not exceeded
  double smallest = 0;  ///< a difference that is no fault; larger where a large facet sends to a small one
  /// Whether light may go to the front of the surface or to the back of another one in the same place, as in a solid
  /// that touches both the surface and the one that sends the light.
  bool isTied = false;
};

/// The sums over what is judged of a row, and the error of that of the matrix. Stated errors are added, or, as those of
/// rays, independent.
struct RowSums {
  double found = 0, truth = 0, stated = 0;
};

/// A row of the matrix; or a column, in the light that the facet receives over that which it would send.
struct JudgedRow : TrueRow {
  bool isColumn = false;
  std::vector<JudgedEntry> to = {};  ///< per surface
  RowSums sums = {};
};

struct JudgedRows {
  std::vector<JudgedRow> all;  ///< rows, then, unless facets share a place, the columns of the same facets
  std::size_t rows = 0;        ///< the number of the former
};

/// Rows that are spread over the mesh, and those whose rough measurement differs the most from the matrix.
JudgedRows judgedRows(const JudgedMatrix& matrix, const JudgeSettings& settings);

/// Entries of a row, or of what it receives, in a matrix whose entry from facet i to facet j is at(i, j): the sum of
/// those to the place of a surface; 0 if it is that of an earlier surface.
template <typename At>
double gathered(const JudgedMatrix& matrix, const JudgedRow& row, std::uint32_t to, const At& at) {
  const std::uint32_t own = row.surface;
  if (row.isColumn) return matrix.area[to] / matrix.area[own] * at(matrix.facet(to), matrix.facet(own));
  double sum = 0;
  for (const std::uint32_t facet : matrix.facetsOf[to]) sum += at(matrix.facet(own), facet);
  return sum;
}

}  // namespace hemitex::reference
