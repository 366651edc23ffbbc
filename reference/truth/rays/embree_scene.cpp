#include "reference/truth/rays/embree_scene.h"

#include <future>
#include <stdexcept>

namespace hemitex::reference {
namespace {

EmbreeScene build(const std::function<RTCGeometry(RTCDevice)>& make, RTCSceneFlags flags) {
  EmbreeScene tree;
  tree.device.reset(rtcNewDevice(nullptr));
  if (!tree.device) throw std::runtime_error("Embree does not run on this machine");
  tree.scene.reset(rtcNewScene(tree.device.get()));
  rtcSetSceneFlags(tree.scene.get(), flags);
  RTCGeometry geometry = make(tree.device.get());
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree.scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(tree.scene.get());
  if (rtcGetDeviceError(tree.device.get()) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree cannot build its tree over the scene");
  return tree;
}

}  // namespace

/// Builds on a separate thread. Embree builds in tasks that flush subnormal numbers to 0, and oneTBB propagates that
/// mode to all later loops of the calling thread.
EmbreeScene embreeTree(const std::function<RTCGeometry(RTCDevice)>& make, RTCSceneFlags flags) {
  return std::async(std::launch::async, [&make, flags] { return build(make, flags); }).get();
}

}  // namespace hemitex::reference
