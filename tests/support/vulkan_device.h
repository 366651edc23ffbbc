/// Whether tests of Vulkan can run.
#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "raster/base/input_error.h"
#include "reference/devices/vulkan/vulkan_renderer.h"
#include "tests/support/raster_scenes.h"

namespace hemitex::tests {

/// False, with a word of the reason, without a device.
inline bool hasVulkanDevice() {
  try {
    reference::makeVulkanRenderer(plainList());
    return true;
  } catch (const raster::InputError& error) {
    REQUIRE(std::string(error.what()).starts_with("no Vulkan device"));
    WARN("skipped: " << error.what());
    return false;
  }
}

}  // namespace hemitex::tests
