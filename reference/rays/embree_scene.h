/// Embree's tree over a geometry, built without a trace on the threads that asked for it. For the sources of this
/// folder: it names Embree's own types, which whoever uses the library need not know.
#pragma once

#include <embree3/rtcore.h>

#include <functional>
#include <memory>

namespace hemitex::reference {

/// Embree's objects are counted by hand.
struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

struct EmbreeScene {
  std::unique_ptr<RTCDeviceTy, ReleaseEmbree> device;
  std::unique_ptr<RTCSceneTy, ReleaseEmbree> scene;
};

/// The tree over the one geometry that `make` returns, not yet committed, made with the device that it is given. Unless
/// the flags say else, rays may not slip between neighbours. Throws std::runtime_error where Embree fails.
EmbreeScene embreeTree(const std::function<RTCGeometry(RTCDevice)>& make, RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST);

}  // namespace hemitex::reference
