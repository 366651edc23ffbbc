/// The two ways in which a Vulkan device draws.
#pragma once

namespace hemitex::reference {

/// How the device draws: with its pipeline for triangles, or by compute shaders (tile_drawing.h), which draw no
/// features of version 2 of the rules.
enum class VulkanPath { Graphics, Compute };

}  // namespace hemitex::reference
