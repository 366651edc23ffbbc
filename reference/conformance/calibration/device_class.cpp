#include "reference/conformance/calibration/device_class.h"

#include <algorithm>
#include <vector>

#include "reference/conformance/diagnosis/staged_device.h"

namespace hemitex::reference {
namespace {

/// A property of devices, as a change of the profile.
struct Hypothesis {
  std::string property;
  DeviceProfile profile;
  std::uint64_t errors = 0;  ///< under the profile
};

/// Whether a device with the snapping of a profile draws at least a fifth of the errors as they are. A profile of few
/// bits explains corners that are moved in any other way, too.
bool drawsAlike(const DeviceProfile& profile, std::span<const JudgedVector> vectors) {
  StagedDevice device;
  device.geometry = snappedTo(profile.subpixelBits, profile.snapRounding == SnapRounding::Nearest);
  std::uint64_t errors = 0, alike = 0;
  for (const auto& [vector, verdict] : vectors) {
    auto face = verdict->faces.begin();
    std::size_t pixel = 0;
    drawOn(device, placeVector(*vector), [&](const raster::ItemBuffer& part) {
      for (const raster::ItemId id : part.ids) {
        for (; pixel == face->pixels.size(); ++face) pixel = 0;
        const bool isError = face->pixels[pixel] == PixelVerdict::Error;
        errors += isError;
        alike += isError && id == face->found.ids[pixel];
        ++pixel;
      }
      return true;
    });
  }
  return 5 * alike >= errors;
}

/// From small changes to large ones.
std::vector<Hypothesis> changesOf(const DeviceProfile& profile, std::span<const JudgedVector> vectors) {
  std::vector<Hypothesis> changes;
  const auto change = [&](const std::string& property, auto member, auto value) {
    if (profile.*member == value) return;
    DeviceProfile changed = profile;
    changed.*member = value;
    changes.push_back({property, changed});
  };
  change("another edge rule, or rows that are reversed on readback", &DeviceProfile::edgeRule, EdgeRule::Any);
  change("interpolation in binary32", &DeviceProfile::interpolationError, 32.0);
  change("texture coordinates of 6 sub-texel bits", &DeviceProfile::texelPrecision, 1.0 / 64);
  change("16-bit depths", &DeviceProfile::depthFormat, DepthFormat::Unorm16);
  const DeviceProfile rules;
  const bool isGuessed = profile.subpixelBits != rules.subpixelBits || profile.snapRounding != rules.snapRounding;
  for (int bits = rules.subpixelBits; bits >= 4 && !isGuessed; --bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) {
      if (bits == profile.subpixelBits && rounding == profile.snapRounding) continue;
      DeviceProfile changed = profile;
      changed.subpixelBits = bits;
      changed.snapRounding = rounding;
      const char* const how = rounding == SnapRounding::Truncate ? " sub-pixel bits, truncated" : " sub-pixel bits";
      if (drawsAlike(changed, vectors)) changes.push_back({std::to_string(bits) + how, changed});
    }
  return changes;
}

/// The errors of the vectors under a profile. It stops counting above `limit`.
std::uint64_t errorsUnder(const DeviceProfile& profile, std::span<const JudgedVector> vectors,
                          std::uint64_t limit = UINT64_MAX) {
  std::uint64_t errors = 0;
  for (const auto& [vector, verdict] : vectors) {
    std::vector<raster::ItemBuffer> expected, found;
    for (const FaceVerdict& face : verdict->faces) {
      expected.push_back(face.expected);
      found.push_back(face.found);
    }
    errors += countVerdicts(judge(*vector, expected, found, profile))[static_cast<std::size_t>(PixelVerdict::Error)];
    if (errors > limit) break;
  }
  return errors;
}

/// The first hypothesis that explains at least 99.5 % of what the best one explains.
Hypothesis bestChange(const DeviceProfile& profile, std::uint64_t errors, std::span<const JudgedVector> vectors) {
  // A change that explains less than half of the errors is of no use; nor is one that isGood beside a best one of half.
  const std::uint64_t limit = errors / 2 + errors / 200 + 1;
  std::vector<Hypothesis> changes = changesOf(profile, vectors);
  std::uint64_t fewest = UINT64_MAX;
  for (Hypothesis& change : changes) {
    change.errors = errorsUnder(change.profile, vectors, limit);
    fewest = std::min(fewest, change.errors);
  }
  const auto isGood = [&](const Hypothesis& change) {
    return change.errors <= fewest || 200 * (change.errors - fewest) <= errors - fewest;
  };
  return *std::find_if(changes.begin(), changes.end(), isGood);
}

}  // namespace

std::optional<DeviceClass> guessDeviceClass(std::span<const JudgedVector> vectors) {
  std::vector<JudgedVector> failing;
  std::copy_if(vectors.begin(), vectors.end(), std::back_inserter(failing),
               [](const JudgedVector& judged) { return hasErrors(*judged.verdict); });
  DeviceClass guess;
  guess.errors = errorsUnder(guess.profile, failing);
  // A device may differ in several properties. Each explains most of the errors that are left, and not only a few.
  std::uint64_t left = guess.errors;
  while (left > 0) {
    const Hypothesis best = bestChange(guess.profile, left, failing);
    if (2 * best.errors > left || 20 * (left - best.errors) < guess.errors) break;
    guess.profile = best.profile;
    if (!guess.properties.empty()) guess.properties += " and ";
    guess.properties += best.property;
    left = best.errors;
  }
  guess.explained = guess.errors - left;
  if (guess.explained == 0) return {};
  return guess;
}

std::string toText(const DeviceClass& guess) {
  return std::to_string(guess.explained) + " of " + std::to_string(guess.errors) + " errors fit a device with " +
         guess.properties;
}

}  // namespace hemitex::reference
