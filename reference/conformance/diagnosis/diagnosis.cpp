#include "reference/conformance/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>

#include "raster/base/parallel.h"
#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;
using ItemIds = std::vector<ItemId>;  // of all faces

constexpr double minAgreement = 0.9;
constexpr std::uint64_t minPixels = 8;

/// Input of the diagnosis. Pixels are those of all faces.
struct Case {
  PlacedVector placed;
  ItemIds rules;  ///< by the staged device, so that its rounding is not part of footprints
  ItemIds found;
  std::vector<bool> isError;

  /// Whether a fault may agree with the device at a pixel. At all others the device shows the item ID of the rules.
  bool mayAgree(std::size_t pixel) const { return isError[pixel] || found[pixel] != rules[pixel]; }
};

Case makeCase(const TestVector& vector, const Verdict& verdict) {
  Case result{placeVector(vector), {}, {}, {}};
  for (const raster::ItemBuffer& buffer : result.placed.buffers)
    result.rules.insert(result.rules.end(), buffer.ids.begin(), buffer.ids.end());
  for (const FaceVerdict& face : verdict.faces) {
    result.found.insert(result.found.end(), face.found.ids.begin(), face.found.ids.end());
    for (const PixelVerdict pixel : face.pixels) result.isError.push_back(pixel == PixelVerdict::Error);
  }
  return result;
}

/// The agreement of a variant on the pixels drawn so far.
struct Agreement {
  std::uint64_t pixels = 0;     ///< errors and footprint
  std::uint64_t agreeing = 0;   ///< of these, equal to the device
  std::uint64_t exact = 0;      ///< of all drawn pixels, equal to the device
  std::uint64_t remaining = 0;  ///< undrawn pixels that may agree

  /// The agreement on the whole vector if all remaining pixels agree.
  double best() const { return static_cast<double>(agreeing + remaining) / static_cast<double>(pixels + remaining); }
  bool mayBeNamed() const { return agreeing + remaining >= minPixels && best() >= minAgreement; }
};

void count(const Case& given, const Variant& variant, std::size_t pixel, ItemId id, Agreement& agreement) {
  const std::vector<Channel>& rounded = variant.rounded;
  const auto areLike = [&](ItemId a, ItemId b) { return a == b || (!rounded.empty() && isClose(rounded, a, b)); };
  const ItemId rules = given.rules[pixel], found = given.found[pixel];
  agreement.remaining -= given.mayAgree(pixel);
  agreement.exact += id == found;
  // A change within rounding is not evidence, unless the device shows exactly this item ID.
  const bool isChanged = !areLike(id, rules);
  if (!given.isError[pixel] && !isChanged) return;
  ++agreement.pixels;
  agreement.agreeing += id != rules && (id == found || (isChanged && areLike(id, found)));
}

/// A variant, and its item IDs if it has enough agreement.
struct Suspect {
  const Fault* fault;
  const Variant* variant;
  double agreement = 0;
  std::uint64_t exact = 0;  ///< pixels of all faces that hold the variant's item ID
  ItemIds ids = {};
};

/// Draws a variant while it may still be named. Most variants are rejected after a few rows.
void compare(const Case& given, std::uint64_t mayAgree, Suspect& suspect) {
  Agreement agreement{.remaining = mayAgree};
  ItemIds ids;
  drawOn(suspect.variant->device, given.placed, [&](const raster::ItemBuffer& part) {
    for (const ItemId id : part.ids) {
      count(given, *suspect.variant, ids.size(), id, agreement);
      ids.push_back(id);
    }
    return agreement.mayBeNamed();
  });
  if (agreement.mayBeNamed())
    suspect = {suspect.fault, suspect.variant, agreement.best(), agreement.exact, std::move(ids)};
}

std::vector<Suspect> suspectsOf(const Case& given, const std::vector<Fault>& faults) {
  std::vector<Suspect> suspects;
  for (const Fault& fault : faults)
    for (const Variant& variant : fault.variants) suspects.push_back({&fault, &variant});
  std::uint64_t mayAgree = 0;
  for (std::size_t pixel = 0; pixel < given.found.size(); ++pixel) mayAgree += given.mayAgree(pixel);
  raster::parallelFor(suspects.size(), [&](std::size_t k) { compare(given, mayAgree, suspects[k]); });
  std::erase_if(suspects, [](const Suspect& suspect) { return suspect.ids.empty(); });
  return suspects;
}

/// Whether the vector cannot distinguish `best` and `other`. Of the pixels that hold the item ID of only one of them,
/// those of `best` outnumber the others by at most two standard deviations of a fair coin.
bool areIndistinct(const Case& given, const Suspect& best, const Suspect& other) {
  std::uint64_t onlyBest = 0, onlyOther = 0;
  for (std::size_t p = 0; p < given.found.size(); ++p) {
    const bool isBest = best.ids[p] == given.found[p], isOther = other.ids[p] == given.found[p];
    onlyBest += isBest && !isOther;
    onlyOther += isOther && !isBest;
  }
  const double lead = static_cast<double>(onlyBest) - static_cast<double>(onlyOther);
  return lead * lead <= 4 * static_cast<double>(onlyBest + onlyOther);
}

}  // namespace

std::vector<Finding> diagnose(const TestVector& vector, const Verdict& verdict) {
  if (!hasErrors(verdict)) return {};
  const std::vector<Fault> faults = knownFaults(vector);
  const Case given = makeCase(vector, verdict);
  std::vector<Suspect> suspects = suspectsOf(given, faults);
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const Suspect& a, const Suspect& b) { return a.exact > b.exact; });
  std::vector<Finding> findings;
  std::vector<const Fault*> named;
  for (const Suspect& suspect : suspects) {
    if (std::find(named.begin(), named.end(), suspect.fault) != named.end()) continue;
    if (!areIndistinct(given, suspects.front(), suspect) && !findings.empty()) continue;
    named.push_back(suspect.fault);
    findings.push_back({suspect.fault->name, suspect.variant->name, suspect.agreement, suspect.fault->advice});
  }
  return findings;
}

std::string toText(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    if (findings.size() > 1) text += text.empty() ? "either " : "; or ";
    const long long tenths = std::llround(1000 * finding.agreement);
    text += finding.fault + (finding.variant.empty() ? "" : ", " + finding.variant) + " (" +
            std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " % agreement): " + finding.advice;
  }
  return text;
}

}  // namespace hemitex::reference
