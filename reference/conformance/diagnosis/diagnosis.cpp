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
constexpr double minPart = 0.125;       // of the changes of a partial variant
constexpr std::uint64_t minPixels = 8;  // of a fault that is named

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

/// Drawn pixels, and how many of them are equal to the device.
struct Share {
  std::uint64_t pixels = 0, agreeing = 0;

  /// If `remaining` pixels agree.
  double with(std::uint64_t remaining) const {
    return static_cast<double>(agreeing + remaining) / static_cast<double>(pixels + remaining);
  }
};

/// The agreement of a variant on the pixels drawn so far.
struct Agreement {
  Share all;                                         ///< errors and footprint
  Share errors;                                      ///< errors alone: what is explained does not stand for them
  Share changes;                                     ///< where the item ID of the variant is not that of the rules
  std::uint64_t exact = 0;                           ///< of all drawn pixels, equal to the device
  std::uint64_t remaining = 0, remainingErrors = 0;  ///< undrawn pixels that may agree, and errors

  /// Whether the fault explains the errors of the whole vector if all remaining pixels agree.
  bool mayExplain(const Variant& variant) const {
    if (variant.isPartial && changes.with(remaining) < minPart) return false;
    return errors.with(remainingErrors) >= minAgreement && all.with(remaining) >= minAgreement;
  }
};

void count(const Case& given, const Variant& variant, std::size_t pixel, ItemId id, Agreement& agreement) {
  const std::vector<Channel>& rounded = variant.rounded;
  const auto areLike = [&](ItemId a, ItemId b) { return a == b || (!rounded.empty() && isClose(rounded, a, b)); };
  const ItemId rules = given.rules[pixel], found = given.found[pixel];
  const bool isError = given.isError[pixel];
  agreement.remaining -= given.mayAgree(pixel);
  agreement.remainingErrors -= isError;
  agreement.exact += id == found;
  if (id != rules) agreement.changes = {agreement.changes.pixels + 1, agreement.changes.agreeing + (id == found)};
  // Within rounding neither a change is evidence for the variant, unless the device shows exactly this item ID, nor an
  // error against it.
  const bool isChanged = !areLike(id, rules), isUnsure = id != found && areLike(id, found);
  if (!isChanged && (!isError || isUnsure)) return;
  const bool agrees = id != rules && (id == found || (isChanged && areLike(id, found)));
  agreement.all = {agreement.all.pixels + 1, agreement.all.agreeing + agrees};
  if (isError) agreement.errors = {agreement.errors.pixels + 1, agreement.errors.agreeing + agrees};
}

/// A variant, and its item IDs if it has enough agreement.
struct Suspect {
  const Fault* fault;
  const Variant* variant;
  double agreement = 0;
  std::uint64_t agreeing = 0;  ///< pixels
  std::uint64_t exact = 0;     ///< pixels of all faces that hold the variant's item ID
  ItemIds ids = {};
};

/// Draws a variant while it may still explain the errors. Most variants are rejected after a few rows.
void compare(const Case& given, const Agreement& undrawn, Suspect& suspect) {
  Agreement agreement = undrawn;
  ItemIds ids;
  drawOn(suspect.variant->device, given.placed, [&](const raster::ItemBuffer& part) {
    for (const ItemId id : part.ids) {
      count(given, *suspect.variant, ids.size(), id, agreement);
      ids.push_back(id);
    }
    return agreement.mayExplain(*suspect.variant);
  });
  if (agreement.mayExplain(*suspect.variant))
    suspect = {suspect.fault,          suspect.variant, agreement.all.with(0),
               agreement.all.agreeing, agreement.exact, std::move(ids)};
}

std::vector<Suspect> suspectsOf(const Case& given, const std::vector<Fault>& faults) {
  std::vector<Suspect> suspects;
  for (const Fault& fault : faults)
    for (const Variant& variant : fault.variants) suspects.push_back({&fault, &variant});
  Agreement undrawn;
  for (std::size_t pixel = 0; pixel < given.found.size(); ++pixel) {
    undrawn.remaining += given.mayAgree(pixel);
    undrawn.remainingErrors += given.isError[pixel];
  }
  raster::parallelFor(suspects.size(), [&](std::size_t k) { compare(given, undrawn, suspects[k]); });
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

Diagnosis diagnoseAll(const TestVector& vector, const Verdict& verdict) {
  if (!hasErrors(verdict)) return {};
  const std::vector<Fault> faults = knownFaults(vector);
  const Case given = makeCase(vector, verdict);
  std::vector<Suspect> suspects = suspectsOf(given, faults);
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const Suspect& a, const Suspect& b) { return a.exact > b.exact; });
  Diagnosis diagnosis;
  std::vector<const Fault*> named;
  const Suspect* best = nullptr;
  for (const Suspect& suspect : suspects) {
    if (std::find(diagnosis.explaining.begin(), diagnosis.explaining.end(), suspect.fault->name) ==
        diagnosis.explaining.end())
      diagnosis.explaining.push_back(suspect.fault->name);
    if (suspect.agreeing < minPixels || std::find(named.begin(), named.end(), suspect.fault) != named.end()) continue;
    if (!best) best = &suspect;
    if (!areIndistinct(given, *best, suspect) && best != &suspect) continue;
    named.push_back(suspect.fault);
    diagnosis.findings.push_back(
        {suspect.fault->name, suspect.variant->name, suspect.agreement, suspect.fault->advice});
  }
  return diagnosis;
}

std::vector<Finding> diagnose(const TestVector& vector, const Verdict& verdict) {
  return diagnoseAll(vector, verdict).findings;
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
