// Rows of form factors by a real device. Without a device, each test reports that it was skipped.
#include <array>
#include <catch2/catch.hpp>
#include <map>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/light/light.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "reference/devices/vulkan/vulkan_renderer.h"
#include "reference/devices/vulkan/vulkan_sums.h"
#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/rates/read_back.h"
#include "tests/support/device_scenes.h"
#include "tests/support/vulkan_device.h"

using namespace hemitex;
using reference::makeVulkanRenderer;
using reference::TestVector;
using reference::VulkanPath;

namespace {

constexpr std::array<VulkanPath, 2> paths{VulkanPath::Graphics, VulkanPath::Compute};

radiosity::RendererFactory drawnBy(VulkanPath path) {
  return [path](const raster::DrawList& list) { return makeVulkanRenderer(list, "", path); };
}

std::vector<glm::dvec3> lightOf(const radiosity::Scene& scene, const radiosity::RendererFactory& renderer) {
  radiosity::LightHooks hooks;
  hooks.makeRenderer = renderer;
  return light(scene, radiosity::discretize(scene, {.texels = 8}),
               {.drawing = {.resolution = 32}, .solver = {.shots = 40}}, hooks)
      .solution.radiosity;
}

/// Weights whose sums have carries between words of 32 bits.
std::vector<std::uint64_t> weightsBefore(std::size_t pixels) {
  std::vector<std::uint64_t> before{0};
  for (std::size_t p = 0; p < pixels; ++p) before.push_back(before.back() + (p % 3) * 0x1234567890 + p % 7);
  return before;
}

}  // namespace

TEST_CASE("A solution with rows by compute shaders has the bits of the software's", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  for (const char* file : {"/cornell-box.obj", "/pyramid-room.obj"}) {
    const radiosity::Scene scene = radiosity::loadScene(std::string(HEMITEX_DATA) + file);
    CHECK(lightOf(scene, drawnBy(VulkanPath::Compute)) == lightOf(scene, radiosity::softwareRenderer));
  }
}

// Views from the middles of elements show aligned grids in perspective. There samples lie on borders of texels that
// double precision misses by its last bit: with it alone, 4 of these 20 rows are wrong.
TEST_CASE("Compute shaders give rows of the gallery the bits of the software's", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/gallery.obj");
  const radiosity::Discretization discretization = radiosity::discretize(scene, {});
  const radiosity::IdLayout layout = radiosity::layOut(discretization, {});
  const auto renderer = [&](const radiosity::RendererFactory& make) {
    return radiosity::sceneRenderer(scene, discretization, layout, radiosity::ElementsBy::Texture, make);
  };
  const auto software = renderer(radiosity::softwareRenderer), device = renderer(drawnBy(VulkanPath::Compute));
  const radiosity::ViewSettings views{.resolution = 64};
  radiosity::ProjectedFormFactors expected(scene, discretization, layout, *software, views);
  radiosity::ProjectedFormFactors found(scene, discretization, layout, *device, views);
  for (const radiosity::Patch& patch : reference::spreadPatches(discretization, 20)) {
    INFO(patch.number);
    CHECK(found.ofPatch(patch) == expected.ofPatch(patch));
  }
}

TEST_CASE("A solution has the same bits whether a device sums pixels or they are read back", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/cornell-box.obj");
  const auto readBack = [](const raster::DrawList& list) {
    return std::make_unique<reference::ReadBack>(makeVulkanRenderer(list));
  };
  CHECK(lightOf(scene, drawnBy(VulkanPath::Graphics)) == lightOf(scene, readBack));
}

TEST_CASE("Compute shaders draw the whole suite as the rules say", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  for (const TestVector& vector : reference::vectorSuite()) {
    INFO(vector.name);
    const auto renderer = makeVulkanRenderer(vector.list, "", VulkanPath::Compute);
    const reference::Verdict verdict = judge(vector, render(*renderer, facesOf(vector)), {});
    CHECK(!hasErrors(verdict));
    const tests::Tally tally = tests::tallyOf(vector, verdict);
    // These ask how devices round vertices; llvmpipe does not round ties to even.
    if (!vector.name.starts_with("snapping")) CHECK(tally.exact == tally.covered);
  }
}

TEST_CASE("Compute shaders refuse what they do not draw", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  raster::DrawList list = tests::plainList();
  list.value = raster::PixelValue::TriangleNumbers;
  CHECK_THROWS_AS(makeVulkanRenderer(list, "", VulkanPath::Compute), raster::InputError);
}

TEST_CASE("Vulkan sums pixels to the slots of their item IDs, with additions of 64 bits or in halves", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  const TestVector vector = tests::suiteVector("five-faces");
  const std::vector<raster::Face> faces = facesOf(vector);
  const std::vector<raster::ItemBuffer> buffers = render(*makeVulkanRenderer(vector.list), faces);
  std::vector<raster::ItemId> ids;
  for (const raster::ItemBuffer& buffer : buffers) ids.insert(ids.end(), buffer.ids.begin(), buffer.ids.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  // Pages of 16 item IDs: a table, consecutive slots from 40, too few of them, and no slots.
  const raster::SlotTable table{.bits = 4,
                                .backId = ids[ids.size() / 2],
                                .back = 60,
                                .blocks = {{16, 0, 0}, {16, 40}, {3, 20}},
                                .slots = {9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 0, 0, 99, 99, 10, 11}};
  const auto slotOf = [&](raster::ItemId id) -> std::uint32_t {
    const std::uint32_t number = id >> 4, index = id & 15;
    if (number == 0) return std::min(table.slots[index], 61U);
    if (number < 3 && index < table.blocks[number].count) return table.blocks[number].first + index;
    return id == table.backId ? 60 : 61;
  };
  std::map<std::uint32_t, std::uint64_t> expected;
  for (const raster::ItemBuffer& buffer : buffers) {
    const std::vector<std::uint64_t> before = weightsBefore(buffer.ids.size());
    for (std::size_t p = 0; p < buffer.ids.size(); ++p)
      if (before[p + 1] > before[p]) expected[slotOf(buffer.ids[p])] += before[p + 1] - before[p];
  }
  for (const VulkanPath path : paths)
    for (const bool inHalves : {false, true}) {
      reference::FaceDrawing drawing = reference::makeFaceDrawing(vector.list, path, "");
      const auto sums = reference::makeVulkanSums(
          drawing, [&] { return table; }, inHalves);
      std::vector<std::size_t> weights;
      for (const raster::ItemBuffer& buffer : buffers)
        weights.push_back(sums->addWeights(weightsBefore(buffer.ids.size())));
      const std::vector<raster::SummedView> views(70, {faces, weights, {}});
      for (const std::size_t count : {1, 70, 3})
        for (const raster::SlotSums& row : sums->sum(std::span(views).first(count))) {
          CHECK(std::is_sorted(row.slots.begin(), row.slots.end()));
          std::map<std::uint32_t, std::uint64_t> found;
          for (std::size_t s = 0; s < row.slots.size(); ++s) found[row.slots[s]] = row.sums[s];
          CHECK(found == expected);
        }
    }
}
