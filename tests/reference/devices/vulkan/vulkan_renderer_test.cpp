// makeVulkanRenderer on a real device. Without a device, each test reports that it was skipped.
#include "reference/devices/vulkan/vulkan_renderer.h"

#include <catch2/catch.hpp>
#include <set>

#include "raster/base/input_error.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/devices/vulkan/memory.h"
#include "tests/support/device_scenes.h"
#include "tests/support/vulkan_device.h"

using namespace hemitex;
using reference::makeVulkanRenderer;
using reference::TestVector;

namespace {

std::vector<raster::ItemBuffer> draw(const TestVector& vector) {
  return render(*makeVulkanRenderer(vector.list), facesOf(vector));
}

std::string refusal(const raster::DrawList& list) {
  try {
    makeVulkanRenderer(list);
    return "";
  } catch (const raster::InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("makeVulkanRenderer draws the whole suite without errors, and 99.99 % of the covered pixels exactly",
          "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  tests::Tally suite;
  for (const TestVector& vector : reference::wholeSuite(HEMITEX_DATA)) {
    INFO(vector.name);
    const reference::Verdict verdict = judge(vector, draw(vector), {});
    CHECK(!hasErrors(verdict));
    // These ask how devices round vertices, which they may choose; llvmpipe's rounding differs between processors.
    if (!vector.name.starts_with("snapping")) suite += tests::tallyOf(vector, verdict);
  }
  CHECK(suite.covered > 200000);
  CHECK(static_cast<double>(suite.exact) >= 0.9999 * static_cast<double>(suite.covered));
}

TEST_CASE("makeVulkanRenderer draws random vectors of all families without errors", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  for (std::uint64_t index = 0; index < 200; ++index) {
    const TestVector vector = reference::interleavedRandomVector(0, index);
    INFO(vector.name);
    CHECK(!hasErrors(judge(vector, draw(vector), {})));
  }
}

TEST_CASE("makeVulkanRenderer draws version 2 of the rules without errors", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  tests::Tally all;
  for (const TestVector& vector : tests::version2Vectors(30)) {
    INFO(vector.name);
    const reference::Verdict verdict = judge(vector, draw(vector), {});
    CHECK(!hasErrors(verdict));
    all += tests::tallyOf(vector, verdict);
  }
  CHECK(all.covered > 10000);
  CHECK(static_cast<double>(all.exact) >= 0.99 * static_cast<double>(all.covered));
}

TEST_CASE("makeVulkanRenderer assembles strips, instances and pairs itself", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  for (const TestVector& vector : reference::drawVectors()) {
    INFO(vector.name);
    CHECK(render(*makeVulkanRenderer(sourceOf(vector)), facesOf(vector)).front().ids == draw(vector).front().ids);
  }
}

TEST_CASE("openVulkanDevice opens devices of one instance, as many as a process needs", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  std::vector<std::unique_ptr<raster::ItemBufferRenderer>> renderers;
  for (int k = 0; k < 64; ++k) renderers.push_back(makeVulkanRenderer(tests::plainList()));
  // Physical devices belong to their instance: another one would have another handle.
  const reference::VulkanContext a = reference::openVulkanDevice(), b = reference::openVulkanDevice();
  CHECK(*a.physicalDevice == *b.physicalDevice);
  CHECK(*a.device != *b.device);
}

TEST_CASE("openVulkanDevice opens the device of a name, and names the others where there is none", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  const std::string name = reference::vulkanDeviceName();
  CHECK(reference::vulkanDeviceName(name.substr(1, 5)) == name);
  CHECK_NOTHROW(makeVulkanRenderer(tests::plainList(), name));
  CHECK_THROWS_WITH(makeVulkanRenderer(tests::plainList(), "abacus"),
                    Catch::Contains("has \"abacus\" in its name; there is ") && Catch::Contains(name));
}

TEST_CASE("memoryType prefers the first choice, and takes the next where the device lacks it", "[vulkan]") {
  using Property = vk::MemoryPropertyFlagBits;
  const vk::MemoryPropertyFlags shared = Property::eHostVisible | Property::eHostCoherent;
  const vk::MemoryPropertyFlags cached = shared | Property::eHostCached;
  vk::PhysicalDeviceMemoryProperties memory;
  memory.memoryTypeCount = 3;
  memory.memoryTypes[0].propertyFlags = Property::eDeviceLocal;
  memory.memoryTypes[1].propertyFlags = shared;
  memory.memoryTypes[2].propertyFlags = cached;
  CHECK(reference::memoryType(memory, 7, {cached, shared}) == 2);
  CHECK(reference::memoryType(memory, 3, {cached, shared}) == 1);
  CHECK(reference::memoryType(memory, 7, {shared, shared}) == 1);
  CHECK_FALSE(reference::memoryType(memory, 1, {cached, shared}));
}

TEST_CASE("makeVulkanRenderer leaves out skipped triangles", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  TestVector vector = tests::suiteVector("five-faces");
  const raster::DrawList whole = vector.list;
  std::vector<std::uint32_t> all(whole.indices.size() / 3);
  for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = t;
  const auto renderer = makeVulkanRenderer(whole);
  for (const std::vector<std::uint32_t>& skipped : {{}, {0}, {1, 2, 7}, {3, 4, 5, 11}, all}) {
    vector.list = tests::without(whole, skipped);
    CHECK(!hasErrors(judge(vector, render(*renderer, facesOf(vector), skipped), {})));
  }
}

TEST_CASE("makeVulkanRenderer draws a face the same alone and among others, before and after larger ones", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  const TestVector vector = tests::suiteVector("five-faces");
  const std::vector<raster::Face> faces = facesOf(vector);
  raster::Face large = faces[0];
  large.resolution *= 4;
  large.scissor = {0, 0, large.resolution, large.resolution};

  const auto renderer = makeVulkanRenderer(vector.list);
  CHECK(render(*renderer, {}).empty());
  const auto idsOf = [&](std::span<const raster::Face> drawn) {
    std::vector<std::vector<raster::ItemId>> ids;
    for (const raster::ItemBuffer& buffer : render(*renderer, drawn)) ids.push_back(buffer.ids);
    return ids;
  };
  const auto together = idsOf(faces);
  REQUIRE(together.size() == 5);
  CHECK(std::set(together.begin(), together.end()).size() == 5);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    CHECK(idsOf({&faces[f], 1}).front() == together[f]);
    const auto withLarge = idsOf(std::array{large, faces[f], large});
    CHECK(withLarge[1] == together[f]);
    CHECK(withLarge[0] == withLarge[2]);
  }
}

TEST_CASE("makeVulkanRenderer drops triangles with a value that is not finite", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  const raster::DrawList list = tests::wallsWithoutFiniteValues();
  const raster::Face face = tests::scaledFrontFace();
  const std::vector<raster::ItemId> expected = tests::drawOne(list, face).ids;
  CHECK(*std::min_element(expected.begin(), expected.end()) >> 8 == list.draws.size() - 1);
  CHECK(render(*makeVulkanRenderer(list), {&face, 1}).front().ids == expected);
}

TEST_CASE("makeVulkanRenderer throws InputError for lists and faces that break the rules", "[vulkan]") {
  if (!tests::hasVulkanDevice()) return;
  raster::DrawList list = tests::plainList();
  CHECK(refusal(list).empty());
  tests::addDraw(list, 0, {}, 0);
  CHECK(refusal(list).find("an index map that does not exist") != std::string::npos);

  const auto renderer = makeVulkanRenderer(tests::plainList());
  const raster::Face odd = tests::frontFace(15);
  CHECK_THROWS_AS(render(*renderer, {&odd, 1}), raster::InputError);
}
