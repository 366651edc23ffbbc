#include "radiosity/row_cache.h"

#include <utility>

namespace hemitex::radiosity {
namespace {

std::size_t bytes(const FormFactorRow& row) {
  return sizeof(row) + row.elements.capacity() * sizeof(std::uint32_t) + row.shares.capacity() * sizeof(std::uint64_t);
}

}  // namespace

const FormFactorRow& RowCache::row(std::uint32_t patch, const RowSource& source) {
  const auto found = byPatch_.find(patch);
  if (found == byPatch_.end())
    keep(patch, source(patch));
  else
    recent_.splice(recent_.begin(), recent_, found->second);
  return recent_.front().row;
}

void RowCache::keep(std::uint32_t patch, FormFactorRow row) {
  if (const auto found = byPatch_.find(patch); found != byPatch_.end()) {
    used_ -= bytes(found->second->row);
    recent_.erase(found->second);
  }
  recent_.push_front({patch, std::move(row)});
  byPatch_[patch] = recent_.begin();
  used_ += bytes(recent_.front().row);
  while (used_ > budget_ && recent_.size() > 1) {
    used_ -= bytes(recent_.back().row);
    byPatch_.erase(recent_.back().patch);
    recent_.pop_back();
  }
}

const FormFactorRow* RowCache::find(std::uint32_t patch) const {
  const auto found = byPatch_.find(patch);
  return found == byPatch_.end() ? nullptr : &found->second->row;
}

}  // namespace hemitex::radiosity
