// Rows of a renderer that sums pixels itself, as graphics cards do, have the bits of rows that are summed here.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "radiosity/discretization/discretize.h"
#include "radiosity/light/light.h"
#include "radiosity/scene/load_scene.h"
#include "raster/software/software_renderer.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using raster::SlotTable;

namespace {

std::uint32_t slotOf(const SlotTable& table, raster::ItemId id) {
  const std::uint32_t number = id >> table.bits, index = id - (number << table.bits);
  if (number >= table.blocks.size() || index >= table.blocks[number].count)
    return id == table.backId ? table.back : table.back + 1;
  const SlotTable::Block& block = table.blocks[number];
  return block.table == SlotTable::none ? block.first + index
                                        : std::min(table.slots[block.table + index], table.back + 1);
}

/// Sums pixel by pixel what the reference renderer draws.
class PlainSums final : public raster::PixelSums {
 public:
  PlainSums(raster::ItemBufferRenderer& renderer, SlotTable table, std::vector<std::size_t>& views)
      : renderer_(renderer), table_(std::move(table)), views_(views) {}

  std::size_t addWeights(std::span<const std::uint64_t> before) override {
    weights_.emplace_back(before.begin(), before.end());
    return weights_.size() - 1;
  }

  std::vector<raster::SlotSums> sum(std::span<const raster::SummedView> views) override {
    views_.push_back(views.size());
    std::vector<raster::SlotSums> rows;
    for (const raster::SummedView& view : views) {
      std::map<std::uint32_t, std::uint64_t> sums;
      const std::vector<raster::ItemBuffer> buffers = render(renderer_, view.faces, view.skipped);
      for (std::size_t f = 0; f < buffers.size(); ++f) {
        const std::vector<std::uint64_t>& before = weights_[view.weights[f]];
        for (std::size_t p = 0; p < buffers[f].ids.size(); ++p)
          if (before[p + 1] > before[p]) sums[slotOf(table_, buffers[f].ids[p])] += before[p + 1] - before[p];
      }
      rows.emplace_back();
      for (const auto& [slot, sum] : sums) {
        rows.back().slots.push_back(slot);
        rows.back().sums.push_back(sum);
      }
    }
    return rows;
  }

 private:
  raster::ItemBufferRenderer& renderer_;
  SlotTable table_;
  std::vector<std::vector<std::uint64_t>> weights_;
  std::vector<std::size_t>& views_;
};

class SummingRenderer final : public raster::ItemBufferRenderer {
 public:
  SummingRenderer(raster::DrawList list, std::vector<std::size_t>& views) : renderer_(std::move(list)), views_(views) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    renderer_.draw(faces, skipped, buffers, drawn);
  }
  std::unique_ptr<raster::PixelSums> makeSums(const std::function<SlotTable()>& table) override {
    return std::make_unique<PlainSums>(renderer_, table(), views_);
  }

 private:
  raster::SoftwareRenderer renderer_;
  std::vector<std::size_t>& views_;
};

}  // namespace

TEST_CASE("A solution along rows of a renderer that sums has the same bits, and draws many at once", "[rows]") {
  for (const char* file : {"/cornell-box.obj", "/furnished-room.obj"}) {
    const Scene scene = loadScene(std::string(HEMITEX_DATA) + file);
    for (const IndexMaps maps : {IndexMaps::Shared, IndexMaps::Packed, IndexMaps::Unique}) {
      const IdSettings ids{.indexMaps = maps};
      std::vector<std::size_t> views;
      const auto lightBy = [&](const RendererFactory& makeRenderer) {
        const LightHooks hooks{
            .layOut = [&](const Discretization& discretization) { return layOut(discretization, ids); },
            .makeRenderer = makeRenderer};
        return light(scene, discretize(scene, {.texels = 6}), {.drawing = {.resolution = 32}, .solver = {.shots = 30}},
                     hooks)
            .solution.radiosity;
      };
      const auto summing = [&](raster::DrawList list) {
        return std::make_unique<SummingRenderer>(std::move(list), views);
      };
      CHECK(lightBy(summing) == lightBy(softwareRenderer));
      CHECK(*std::max_element(views.begin(), views.end()) > 8);
    }
  }
}
