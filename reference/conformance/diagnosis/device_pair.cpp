#include "reference/conformance/diagnosis/device_pair.h"

namespace hemitex::reference {
namespace {

/// Whether a stage is not the one of a right device: another function, or another value.
template <typename Result, typename... Arguments>
bool isChanged(const std::function<Result(Arguments...)>& stage, const std::function<Result(Arguments...)>& right) {
  return stage.target_type() != right.target_type();
}
template <typename Value>
bool isChanged(const Value& value, const Value& right) {
  return !(value == right);
}
bool isChanged(const std::vector<raster::SnappedPoint>& samples, const std::vector<raster::SnappedPoint>& right) {
  return samples.size() != right.size() || isChanged(samples.front().x, right.front().x) ||
         isChanged(samples.front().y, right.front().y);
}
bool isChanged(const raster::SnappedPoint& a, const raster::SnappedPoint& b) { return a.x != b.x || a.y != b.y; }
bool isChanged(const std::optional<StagedGeometry>& geometry, const std::optional<StagedGeometry>&) {
  return geometry.has_value();
}

/// Takes a stage that only one of two devices changes. Returns whether it is so.
template <typename Stage>
bool takeChanged(StagedDevice& both, const StagedDevice& other, Stage StagedDevice::*stage) {
  static const StagedDevice right;
  if (!isChanged(other.*stage, right.*stage)) return true;
  if (isChanged(both.*stage, right.*stage)) return false;
  both.*stage = other.*stage;
  return true;
}

/// One change after the other; either may be empty.
template <typename... Arguments>
std::function<void(Arguments...)> inTurn(const std::function<void(Arguments...)>& first,
                                         const std::function<void(Arguments...)>& second) {
  if (!first || !second) return first ? first : second;
  return [=](Arguments... arguments) {
    first(arguments...);
    second(arguments...);
  };
}

/// The second device's view among the first one's views of all faces.
auto camerasOf(const StagedDevice& first, const StagedDevice& second) {
  if (!first.camera || !second.camera) return first.camera ? first.camera : second.camera;
  return decltype(first.camera)(
      [a = first.camera, b = second.camera](std::span<const raster::Face> faces, std::size_t f) {
        std::vector<raster::Face> views;
        for (std::size_t k = 0; k < faces.size(); ++k) {
          views.push_back(a(faces, k));
          views.back().resolution = faces[k].resolution;
          views.back().scissor = faces[k].scissor;
        }
        return b(views, f);
      });
}

}  // namespace

std::optional<StagedDevice> pairOf(const StagedDevice& first, const StagedDevice& second) {
  StagedDevice both = first;
  both.upload = inTurn(first.upload, second.upload);
  both.camera = camerasOf(first, second);
  both.readBack = inTurn(first.readBack, second.readBack);
  both.isDrawnByRules = first.isDrawnByRules && second.isDrawnByRules;
  const auto takeAll = [&](auto... stages) { return (takeChanged(both, second, stages) && ...); };
  using Device = StagedDevice;
  if (!takeAll(&Device::geometry, &Device::facing, &Device::ownsSamples, &Device::keeps, &Device::widening,
               &Device::drawsLines, &Device::samples, &Device::shadingSample, &Device::shadesSamples,
               &Device::shadingBlock, &Device::depth, &Device::passes, &Device::depthBias, &Device::clearedDepth,
               &Device::keepsDepth, &Device::interpolate, &Device::fetch, &Device::blend, &Device::fade, &Device::store,
               &Device::resolve))
    return {};
  return both;
}

}  // namespace hemitex::reference
