/// Registers the suite for two backends: the plain renderer, which is right, and one whose pictures are upside down.
#define CATCH_CONFIG_PREFIX_ALL  // the names of Catch2's macros are no concern of the tests
#include <algorithm>
#include <cstdlib>
#include <memory>

#include "raster/plain/plain_renderer.h"
#include "reference/conformance/cases/catch2_tests.h"

namespace {

using namespace hemitex;

/// The plain renderer, with the rows of each face in reverse order.
class UpsideDown final : public raster::ItemBufferRenderer {
 public:
  explicit UpsideDown(const raster::DrawList& list) : right_(list) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    right_.draw(faces, skipped, buffers, [](std::size_t) {});
    for (std::size_t f = 0; f < buffers.size(); ++f) {
      raster::ItemBuffer& buffer = buffers[f];
      for (int row = 0; row < buffer.height / 2; ++row) {
        const auto first = buffer.ids.begin() + row * buffer.width;
        std::swap_ranges(first, first + buffer.width, buffer.ids.end() - (row + 1) * buffer.width);
      }
      drawn(f);
    }
  }

 private:
  raster::PlainRenderer right_;
};

/// The value of an environment variable; empty if it is not set.
std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

reference::ConformanceSettings settings() {
  reference::ConformanceSettings result{.suite = variable("SUITE"), .expectations = variable("EXPECTATIONS")};
  if (const std::string profile = variable("PROFILE"); !profile.empty()) result.profiles.push_back(profile);
  return result;
}

const std::size_t rightTests = reference::registerConformanceTests(
    "right", [](const raster::DrawList& list) { return std::make_unique<raster::PlainRenderer>(list); }, settings());
const std::size_t wrongTests = reference::registerConformanceTests(
    "wrong", [](const raster::DrawList& list) { return std::make_unique<UpsideDown>(list); }, settings());

}  // namespace
