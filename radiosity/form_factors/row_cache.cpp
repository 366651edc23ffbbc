#include "radiosity/form_factors/row_cache.h"

#include <utility>

namespace hemitex::radiosity {
namespace {

std::size_t bytes(const FormFactorRow& row) {
  return sizeof(row) + row.elements.capacity() * sizeof(std::uint32_t) + row.shares.capacity() * sizeof(std::uint64_t);
}

}  // namespace

const FormFactorRow& RowCache::row(std::uint64_t number, const std::function<FormFactorRow()>& make) {
  const auto found = byNumber_.find(number);
  if (found == byNumber_.end())
    keep(number, make());
  else
    recent_.splice(recent_.begin(), recent_, found->second);
  return recent_.front().row;
}

void RowCache::keep(std::uint64_t number, FormFactorRow row) {
  if (const auto found = byNumber_.find(number); found != byNumber_.end()) {
    used_ -= bytes(found->second->row);
    recent_.erase(found->second);
  }
  recent_.push_front({number, std::move(row)});
  byNumber_[number] = recent_.begin();
  used_ += bytes(recent_.front().row);
  while (used_ > budget_ && recent_.size() > 1) {
    used_ -= bytes(recent_.back().row);
    byNumber_.erase(recent_.back().number);
    recent_.pop_back();
  }
}

const FormFactorRow* RowCache::find(std::uint64_t number) const {
  const auto found = byNumber_.find(number);
  return found == byNumber_.end() ? nullptr : &found->second->row;
}

}  // namespace hemitex::radiosity
