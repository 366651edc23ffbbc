#include "radiosity/geometry/box_tree.h"

#include <algorithm>
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/algorithms/equals.hpp>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <utility>

namespace hemitex::radiosity {
namespace {

namespace index = boost::geometry::index;
using BoostPoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
using BoostBox = boost::geometry::model::box<BoostPoint>;
using Entry = std::pair<BoostBox, std::uint32_t>;

BoostBox boostBox(const PlaneBox& box) { return {{box.low.x, box.low.y}, {box.high.x, box.high.y}}; }

std::vector<Entry> entriesOf(std::span<const PlaneBox> boxes) {
  std::vector<Entry> entries;
  entries.reserve(boxes.size());
  for (const PlaneBox& box : boxes) entries.emplace_back(boostBox(box), static_cast<std::uint32_t>(entries.size()));
  return entries;
}

}  // namespace

struct BoxTree::Implementation {
  explicit Implementation(std::span<const PlaneBox> boxes) : tree(entriesOf(boxes)) {}

  index::rtree<Entry, index::quadratic<16>> tree;
};

BoxTree::BoxTree(std::span<const PlaneBox> boxes) : implementation_(std::make_unique<Implementation>(boxes)) {}
BoxTree::~BoxTree() = default;
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;

void BoxTree::add(const PlaneBox& box, std::uint32_t number) { implementation_->tree.insert({boostBox(box), number}); }

void BoxTree::remove(const PlaneBox& box, std::uint32_t number) {
  implementation_->tree.remove({boostBox(box), number});
}

void BoxTree::find(const PlaneBox& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  const auto& tree = implementation_->tree;
  for (auto it = tree.qbegin(index::intersects(boostBox(box))); it != tree.qend(); ++it) found.push_back(it->second);
  std::sort(found.begin(), found.end());
}

}  // namespace hemitex::radiosity
