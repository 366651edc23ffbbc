#include "raster/software/prepared_draw_list.h"

#include <utility>

namespace hemitex::raster {
namespace {

PreparedDrawList::MapTraits traitsOf(const IndexMap& map) {
  PreparedDrawList::MapTraits traits{true, 0, hasHoles(map)};
  for (std::size_t i = 0; i < map.ids.size(); ++i) {
    traits.countsTexels = traits.countsTexels && map.ids[i] == i;
    if (map.ids[i] != holeTexel) traits.bits |= map.ids[i];
  }
  return traits;
}

template <typename Value>
void prefetch(const std::vector<Value>& values, std::size_t first, std::size_t count) {
  constexpr std::size_t line = 64;  // bytes of a cache line
  const auto* const begin = reinterpret_cast<const char*>(values.data() + first);
  for (std::size_t byte = 0; byte < count * sizeof(Value); byte += line) __builtin_prefetch(begin + byte);
}

}  // namespace

PreparedDrawList prepare(DrawList list) {
  validate(list);
  requireUsual(list);
  PreparedDrawList draws;
  draws.list = std::move(list);
  draws.clusters = clustersOf(draws.list);
  draws.tree = ClusterBvh(draws.clusters);
  draws.mesh = meshOf(draws.list, draws.clusters);
  for (const IndexMap& map : draws.list.indexMaps) draws.maps.push_back(traitsOf(map));
  return draws;
}

void prefetch(const PreparedDrawList& draws, std::uint32_t cluster) {
  const ClusterPart& part = draws.mesh.parts[cluster];
  for (const auto& values : draws.mesh.positions) prefetch(values, part.firstVertex, part.vertices);
  prefetch(draws.mesh.texcoords, part.firstVertex, part.vertices);
  for (const auto& corners : draws.mesh.corners) prefetch(corners, part.firstTriangle, part.triangles);
  prefetch(draws.clusters[cluster].runs, 0, 1);
}

}  // namespace hemitex::raster
