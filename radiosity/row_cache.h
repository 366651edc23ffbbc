/// Rows of form factors within a budget of memory; the row used longest ago goes first. No answer depends on it: a row
/// that was dropped is computed again, to the same bits.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>

#include "radiosity/form_factors.h"

namespace hemitex::radiosity {

/// Where a patch's row comes from: the hemicube, or any other method.
using RowSource = std::function<FormFactorRow(std::uint32_t patch)>;

class RowCache {
 public:
  /// `budget` in bytes; the row used last is kept whatever it takes.
  explicit RowCache(std::size_t budget) : budget_(budget) {}

  /// The row of a patch, from the source where it is not kept. Valid until the next call.
  const FormFactorRow& row(std::uint32_t patch, const RowSource& source);
  /// Keeps a row that was found elsewhere, in place of what was kept for its patch.
  void keep(std::uint32_t patch, FormFactorRow row);
  /// The row kept for a patch; none: null. Valid until the next call of `row` or `keep`.
  const FormFactorRow* find(std::uint32_t patch) const;

 private:
  struct Entry {
    std::uint32_t patch;
    FormFactorRow row;
  };

  std::size_t budget_;
  std::size_t used_ = 0;
  std::list<Entry> recent_;  ///< the one used last first
  std::map<std::uint32_t, std::list<Entry>::iterator> byPatch_;
};

}  // namespace hemitex::radiosity
