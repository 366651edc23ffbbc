/// A cache of form-factor rows with a memory budget; drops the least recently used row. Results do not depend on it,
/// because a dropped row is computed again with the same bits.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>

#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/near_receivers.h"

namespace hemitex::radiosity {

class RowCache {
 public:
  /// `budget` in bytes. The most recent row is always kept.
  explicit RowCache(std::size_t budget) : budget_(budget) {}
  RowCache(RowCache&&) = default;
  RowCache& operator=(RowCache&&) = default;

  /// The row of a number (that of a patch, for example); calls `make` if it is not in the cache. Valid until the next
  /// call.
  const FormFactorRow& row(std::uint64_t number, const std::function<FormFactorRow()>& make);
  /// Stores a row, replacing that of the same number.
  void keep(std::uint64_t number, FormFactorRow row);
  /// The row of a number, or null. Valid until the next call of `row` or `keep`.
  const FormFactorRow* find(std::uint64_t number) const;

 private:
  struct Entry {
    std::uint64_t number;
    FormFactorRow row;
  };

  std::size_t budget_;
  std::size_t used_ = 0;
  std::list<Entry> recent_;  ///< most recently used first
  std::map<std::uint64_t, std::list<Entry>::iterator> byNumber_;
};

/// Rows of patches, and of the views that they are made from. Windows update rows of views exactly, so that what is
/// made from them equals a complete drawing.
struct KeptRows {
  RowCache ofPatches;
  RowCache ofViews;  ///< by view number (see dynamic_solution.h)
  NearRows near = {};
};

}  // namespace hemitex::radiosity
