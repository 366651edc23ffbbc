#include "reference/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "raster/base/parallel.h"
#include "reference/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;
using ItemIds = std::vector<ItemId>;  // of all faces

constexpr double minAgreement = 0.9;
constexpr std::uint64_t fewestPixels = 8;

ItemIds idsOf(const std::vector<raster::ItemBuffer>& buffers) {
  ItemIds ids;
  for (const raster::ItemBuffer& buffer : buffers) ids.insert(ids.end(), buffer.ids.begin(), buffer.ids.end());
  return ids;
}

/// What is diagnosed.
struct Case {
  ItemIds rules;  ///< by the staged device, whose rounding is then no footprint
  ItemIds found;
  std::vector<bool> isError;
};

Case makeCase(const TestVector& vector, const Verdict& verdict) {
  Case result{idsOf(drawOn(StagedDevice{}, vector)), {}, {}};
  for (const FaceVerdict& face : verdict.faces) {
    result.found.insert(result.found.end(), face.found.ids.begin(), face.found.ids.end());
    for (const PixelVerdict pixel : face.pixels) result.isError.push_back(pixel == PixelVerdict::Error);
  }
  return result;
}

/// A variant that agrees.
struct Suspect {
  const Fault* fault;
  const Variant* variant;
  double agreement;
  std::uint64_t exact;  ///< pixels of all that hold the variant's item ID
  ItemIds ids;
};

std::optional<Suspect> compare(const Case& given, const Fault& fault, const Variant& variant, ItemIds ids) {
  const std::vector<Channel>& rounded = variant.rounded;
  const auto areLike = [&](ItemId a, ItemId b) { return a == b || (!rounded.empty() && isClose(rounded, a, b)); };
  std::uint64_t pixels = 0, agreeing = 0, exact = 0;
  for (std::size_t p = 0; p < ids.size(); ++p) {
    const bool isChanged = ids[p] != given.rules[p];
    exact += ids[p] == given.found[p];
    // A change that rounding may undo says nothing.
    if (!given.isError[p] && areLike(ids[p], given.rules[p])) continue;
    ++pixels;
    agreeing += isChanged && areLike(ids[p], given.found[p]);
  }
  const double agreement = static_cast<double>(agreeing) / static_cast<double>(pixels);
  if (agreeing < fewestPixels || agreement < minAgreement) return {};
  return Suspect{&fault, &variant, agreement, exact, std::move(ids)};
}

std::vector<Suspect> suspectsOf(const TestVector& vector, const Case& given, const std::vector<Fault>& faults) {
  struct Candidate {
    const Fault* fault;
    const Variant* variant;
  };
  std::vector<Candidate> candidates;
  for (const Fault& fault : faults)
    for (const Variant& variant : fault.variants) candidates.push_back({&fault, &variant});
  std::vector<std::optional<Suspect>> compared(candidates.size());
  raster::parallelFor(candidates.size(), [&](std::size_t k) {
    const auto& [fault, variant] = candidates[k];
    compared[k] = compare(given, *fault, *variant, idsOf(drawOn(variant->device, vector)));
  });
  std::vector<Suspect> suspects;
  for (std::optional<Suspect>& suspect : compared)
    if (suspect) suspects.push_back(std::move(*suspect));
  return suspects;
}

/// Whether `best` and `other` could be exchanged: of the pixels that hold the item ID of one of the two, those of
/// `best` outnumber the others by no more than two standard deviations of a fair coin.
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
  std::vector<Suspect> suspects = suspectsOf(vector, given, faults);
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
    char percent[16];
    std::snprintf(percent, sizeof percent, "%.1f", 100 * finding.agreement);
    text += finding.fault + (finding.variant.empty() ? "" : ", " + finding.variant) + " (" + percent +
            " % agreement): " + finding.advice;
  }
  return text;
}

}  // namespace hemitex::reference
