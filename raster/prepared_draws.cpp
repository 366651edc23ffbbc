#include "raster/prepared_draws.h"

#include <utility>

namespace hemitex::raster {
namespace {

PreparedDraws::MapTraits traitsOf(const IndexMap& map) {
  PreparedDraws::MapTraits traits{true, 0};
  for (std::size_t i = 0; i < map.words.size(); ++i) {
    traits.countsTexels = traits.countsTexels && map.words[i] == i;
    traits.bits |= map.words[i];
  }
  return traits;
}

}  // namespace

PreparedDraws prepare(DrawList list) {
  validate(list);
  PreparedDraws draws;
  draws.list = std::move(list);
  draws.clusters = clustersOf(draws.list);
  draws.tree = ClusterTree(draws.clusters);
  draws.mesh = meshOf(draws.list, draws.clusters);
  for (const IndexMap& map : draws.list.indexMaps) draws.maps.push_back(traitsOf(map));
  return draws;
}

}  // namespace hemitex::raster
