/// Rows of form factors within a budget of memory; the row used longest ago goes first. No answer depends on it: a row
/// that was dropped is computed again, to the same bits.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>

#include "radiosity/form_factors/form_factor_row.h"

namespace hemitex::radiosity {

/// Where a patch's row comes from: the hemicube, or any other method.
using RowSource = std::function<FormFactorRow(std::uint32_t patch)>;

class RowCache {
 public:
  /// `budget` in bytes; the row used last is kept whatever it takes.
  explicit RowCache(std::size_t budget) : budget_(budget) {}

  /// The row of a number (a patch's, say), made where it is not kept. Valid until the next call.
  const FormFactorRow& row(std::uint64_t number, const std::function<FormFactorRow()>& make);
  /// Keeps a row that was found elsewhere, in place of what was kept for its number.
  void keep(std::uint64_t number, FormFactorRow row);
  /// The row kept for a number; none: null. Valid until the next call of `row` or `keep`.
  const FormFactorRow* find(std::uint64_t number) const;

 private:
  struct Entry {
    std::uint64_t number;
    FormFactorRow row;
  };

  std::size_t budget_;
  std::size_t used_ = 0;
  std::list<Entry> recent_;  ///< the one used last first
  std::map<std::uint64_t, std::list<Entry>::iterator> byNumber_;
};

}  // namespace hemitex::radiosity
