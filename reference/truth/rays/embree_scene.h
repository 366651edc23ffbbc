/// Builds Embree's tree over a geometry without changing the floating-point mode of the calling threads. For the
/// sources of this folder only: it exposes Embree's types, which users of the library need not know.
#pragma once

#include <embree3/rtcore.h>

#include <functional>
#include <memory>

namespace hemitex::reference {

/// Embree's objects have reference counts without automatic release.
struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

struct EmbreeScene {
  std::unique_ptr<RTCDeviceTy, ReleaseEmbree> device;
  std::unique_ptr<RTCSceneTy, ReleaseEmbree> scene;
};

/// The tree over the one geometry that `make` returns; `make` gets the device and must not commit the geometry. By
/// default the flags prevent that rays pass between neighbours. Throws std::runtime_error if Embree fails.
EmbreeScene embreeTree(const std::function<RTCGeometry(RTCDevice)>& make, RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST);

}  // namespace hemitex::reference
