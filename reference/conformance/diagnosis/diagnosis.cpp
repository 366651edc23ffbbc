#include "reference/conformance/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "raster/base/parallel.h"
#include "reference/conformance/diagnosis/device_pair.h"
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
struct Overlap {
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

void count(const Case& given, const Variant& variant, std::size_t pixel, ItemId id, Overlap& agreement) {
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

/// How a device that explains the errors agrees with the found item IDs. Without item IDs it does not explain them.
struct Match {
  double agreement = 0;
  std::uint64_t agreeing = 0;  ///< pixels
  std::uint64_t exact = 0;     ///< pixels of all faces that hold the device's item ID
  ItemIds ids = {};
};

/// Draws some rows at a time while the function that it gets returns true.
using Drawing = std::function<void(const std::function<bool(const raster::ItemBuffer&)>&)>;

/// Draws while the variant may still explain the errors. Most variants are rejected after a few rows.
Match compare(const Case& given, const Overlap& undrawn, const Variant& variant, const Drawing& draw) {
  Overlap agreement = undrawn;
  ItemIds ids;
  draw([&](const raster::ItemBuffer& part) {
    for (const ItemId id : part.ids) {
      count(given, variant, ids.size(), id, agreement);
      ids.push_back(id);
    }
    return agreement.mayExplain(variant);
  });
  if (!agreement.mayExplain(variant)) return {};
  return {agreement.all.with(0), agreement.all.agreeing, agreement.exact, std::move(ids)};
}

Match compare(const Case& given, const Overlap& undrawn, const Variant& variant) {
  return compare(given, undrawn, variant,
                 [&](const auto& wantsMore) { drawOn(variant.device, given.placed, wantsMore); });
}

/// The agreement before anything is drawn.
Overlap undrawnOf(const Case& given) {
  Overlap undrawn;
  for (std::size_t pixel = 0; pixel < given.found.size(); ++pixel) {
    undrawn.remaining += given.mayAgree(pixel);
    undrawn.remainingErrors += given.isError[pixel];
  }
  return undrawn;
}

/// A variant, and how it agrees.
struct Suspect {
  const Fault* fault;
  const Variant* variant;
  Match match = {};
};

std::vector<Suspect> suspectsOf(const Case& given, const std::vector<Fault>& faults) {
  std::vector<Suspect> suspects;
  for (const Fault& fault : faults)
    for (const Variant& variant : fault.variants) suspects.push_back({&fault, &variant});
  const Overlap undrawn = undrawnOf(given);
  raster::parallelFor(suspects.size(),
                      [&](std::size_t k) { suspects[k].match = compare(given, undrawn, *suspects[k].variant); });
  std::erase_if(suspects, [](const Suspect& suspect) { return suspect.match.ids.empty(); });
  return suspects;
}

/// Whether the vector cannot distinguish `best` and `other`. Of the pixels that hold the item ID of only one of them,
/// those of `best` outnumber the others by at most two standard deviations of a fair coin.
bool areIndistinct(const Case& given, const Match& best, const Match& other) {
  std::uint64_t onlyBest = 0, onlyOther = 0;
  for (std::size_t p = 0; p < given.found.size(); ++p) {
    const bool isBest = best.ids[p] == given.found[p], isOther = other.ids[p] == given.found[p];
    onlyBest += isBest && !isOther;
    onlyOther += isOther && !isBest;
  }
  const double lead = static_cast<double>(onlyBest) - static_cast<double>(onlyOther);
  return lead * lead <= 4 * static_cast<double>(onlyBest + onlyOther);
}

/// Of a suspect or an effect.
Finding findingOf(const auto& changed, const Match& match) {
  return {changed.fault->name, changed.variant->name, match.agreement, changed.fault->advice};
}

// --- two faults at once ---

/// A variant with an effect on the vector, the list that it draws if it is another one, and its item buffers.
struct Effect {
  const Fault* fault;
  const Variant* variant;
  std::optional<raster::DrawList> uploaded = {};
  std::vector<raster::ItemBuffer> buffers = {};
};

void draw(const PlacedVector& placed, Effect& effect) {
  const StagedDevice& device = effect.variant->device;
  effect.uploaded = uploadedOn(device, placed);
  for (const raster::Face& face : placed.faces) effect.buffers.emplace_back().resize(face.scissor);
  std::size_t f = 0, pixel = 0;
  drawOn(device, placed, effect.uploaded ? *effect.uploaded : placed.list, [&](const raster::ItemBuffer& part) {
    std::vector<ItemId>& ids = effect.buffers[f].ids;
    std::copy(part.ids.begin(), part.ids.end(), ids.begin() + static_cast<std::ptrdiff_t>(pixel));
    pixel += part.ids.size();
    if (pixel == ids.size()) pixel = 0, ++f;
    return true;
  });
}

bool areEqual(const std::vector<raster::ItemBuffer>& a, const std::vector<raster::ItemBuffer>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const raster::ItemBuffer& x, const raster::ItemBuffer& y) { return x.ids == y.ids; });
}

/// The variants that change the vector, each change of a fault once.
std::vector<Effect> effectsOf(const Case& given, const std::vector<Fault>& faults) {
  std::vector<Effect> all, different;
  for (const Fault& fault : faults)
    for (const Variant& variant : fault.variants)
      if (!variant.isPartial) all.push_back({&fault, &variant});
  raster::parallelFor(all.size(), [&](std::size_t k) { draw(given.placed, all[k]); });
  for (Effect& effect : all) {
    const auto isSame = [&](const Effect& other) {
      return other.fault == effect.fault && areEqual(other.buffers, effect.buffers);
    };
    if (!areEqual(effect.buffers, given.placed.buffers) && std::none_of(different.begin(), different.end(), isSame))
      different.push_back(std::move(effect));
  }
  return different;
}

/// The list that two faults draw, for which `changed` has room.
const raster::DrawList& uploadedBy(const Case& given, const Effect& first, const Effect& second,
                                   raster::DrawList& changed) {
  if (!first.uploaded) return second.uploaded ? *second.uploaded : given.placed.list;
  if (!second.variant->device.upload) return *first.uploaded;
  changed = *first.uploaded;
  second.variant->device.upload(changed);
  return changed;
}

/// How two faults agree, the change of the first one before that of the second.
Match compare(const Case& given, const Overlap& undrawn, const Effect& first, const Effect& second) {
  Variant both{{}, {}, first.variant->rounded.empty() ? second.variant->rounded : first.variant->rounded};
  if (second.variant->device.isDrawnByRules)
    return compare(given, undrawn, both, [&](const auto& wantsMore) {
      for (std::size_t f = 0; f < first.buffers.size(); ++f) {
        raster::ItemBuffer buffer = first.buffers[f];
        second.variant->device.readBack(given.placed.faces[f], buffer);
        if (!wantsMore(buffer)) return;
      }
    });
  const std::optional<StagedDevice> device = pairOf(first.variant->device, second.variant->device);
  if (!device) return {};
  both.device = *device;
  raster::DrawList changed;
  const raster::DrawList& list = uploadedBy(given, first, second, changed);
  return compare(given, undrawn, both,
                 [&](const auto& wantsMore) { drawOn(both.device, given.placed, list, wantsMore); });
}

/// Whether the order of the two changes matters.
bool areInTurn(const StagedDevice& a, const StagedDevice& b) {
  return (a.upload && b.upload) || (a.camera && b.camera) || (a.readBack && b.readBack);
}

struct PairSuspect {
  const Effect *first, *second;
  Match match;
};

/// All pairs of two faults that explain the errors.
std::vector<PairSuspect> pairSuspectsOf(const Case& given, const std::vector<Effect>& effects) {
  const Overlap undrawn = undrawnOf(given);
  std::vector<std::vector<PairSuspect>> perEffect(effects.size());
  raster::parallelFor(effects.size(), [&](std::size_t k) {
    for (const Effect& other : effects) {
      const Effect& effect = effects[k];
      const bool isReadBack = effect.variant->device.isDrawnByRules;
      const bool otherIsReadBack = other.variant->device.isDrawnByRules;
      // A change of what is read back comes second; of two in either order both are tried, of all others one.
      if (effect.fault == other.fault || (isReadBack && !otherIsReadBack)) continue;
      if (!otherIsReadBack && !areInTurn(effect.variant->device, other.variant->device) && &other > &effect) continue;
      Match match = compare(given, undrawn, effect, other);
      if (match.agreeing >= minPixels) perEffect[k].push_back({&effect, &other, std::move(match)});
    }
  });
  std::vector<PairSuspect> all;
  for (std::vector<PairSuspect>& some : perEffect)
    for (PairSuspect& suspect : some) all.push_back(std::move(suspect));
  return all;
}

}  // namespace

std::vector<PairFinding> diagnosePairs(const TestVector& vector, const Verdict& verdict,
                                       std::span<const std::string> names) {
  if (!hasErrors(verdict)) return {};
  const Case given = makeCase(vector, verdict);
  std::vector<Fault> faults = knownFaults(vector);
  const auto isUnnamed = [&](const Fault& fault) {
    return std::find(names.begin(), names.end(), fault.name) == names.end();
  };
  if (!names.empty()) std::erase_if(faults, isUnnamed);
  const std::vector<Effect> effects = effectsOf(given, faults);
  std::vector<PairSuspect> suspects = pairSuspectsOf(given, effects);
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const PairSuspect& a, const PairSuspect& b) { return a.match.exact > b.match.exact; });
  std::vector<PairFinding> findings;
  std::set<std::set<std::string>> named;
  for (const PairSuspect& suspect : suspects) {
    if (!areIndistinct(given, suspects.front().match, suspect.match) && !findings.empty()) continue;
    if (!named.insert({suspect.first->fault->name, suspect.second->fault->name}).second) continue;
    findings.push_back({findingOf(*suspect.first, suspect.match), findingOf(*suspect.second, suspect.match)});
  }
  return findings;
}

Diagnosis diagnoseAll(const TestVector& vector, const Verdict& verdict) {
  if (!hasErrors(verdict)) return {};
  const Case given = makeCase(vector, verdict);
  std::vector<Fault> faults = knownFaults(vector);
  faults.push_back(fogLike(given.placed, given.found));
  std::vector<Suspect> suspects = suspectsOf(given, faults);
  std::stable_sort(suspects.begin(), suspects.end(),
                   [](const Suspect& a, const Suspect& b) { return a.match.exact > b.match.exact; });
  Diagnosis diagnosis;
  std::vector<const Fault*> named;
  const Suspect* best = nullptr;
  for (const Suspect& suspect : suspects) {
    if (std::find(diagnosis.explaining.begin(), diagnosis.explaining.end(), suspect.fault->name) ==
        diagnosis.explaining.end())
      diagnosis.explaining.push_back(suspect.fault->name);
    if (suspect.match.agreeing < minPixels || std::find(named.begin(), named.end(), suspect.fault) != named.end())
      continue;
    if (!best) best = &suspect;
    if (!areIndistinct(given, best->match, suspect.match) && best != &suspect) continue;
    named.push_back(suspect.fault);
    diagnosis.findings.push_back(findingOf(suspect, suspect.match));
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
