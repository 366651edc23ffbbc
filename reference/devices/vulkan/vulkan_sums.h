/// Sums of pixels on a Vulkan device, by two compute shaders: sum_pixels.comp adds the weights of runs of equal item
/// IDs to the sums of their slots, and list_sums.comp lists the sums that are not 0. Only these are read back. While
/// the device draws and sums some views, this program records others.
#pragma once

#include <functional>
#include <memory>

#include "raster/interface/pixel_sums.h"
#include "reference/devices/vulkan/face_drawing.h"

namespace hemitex::reference {

/// The drawing must outlive the result. Null if a view has more slots than a buffer of the device. With `inHalves`
/// sums are added as two words with a carry, as they are on devices that cannot add 64 bits in one step.
std::unique_ptr<raster::PixelSums> makeVulkanSums(FaceDrawing& drawing, const std::function<raster::SlotTable()>& table,
                                                  bool inHalves = false);

}  // namespace hemitex::reference
