#include "reference/devices/choice/judged_device.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/software/software_renderer.h"
#include "reference/base/hashes/sha256.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/verdict/verdict.h"

namespace hemitex::reference {
namespace {

using nlohmann::ordered_json;

/// What is known of a device.
struct Judgement {
  std::uint64_t exact = 0, explained = 0;  ///< pixels
  std::vector<std::string> wrong;          ///< vectors with errors, or with wrong sums
};

/// A weight that grows along a face, such that sums over a vector have carries between words.
std::uint64_t weightOf(std::size_t pixel) { return (pixel + 1) * 0x180000001; }

/// The sums of pixels by item ID; those above `largest` are one.
std::map<std::uint32_t, std::uint64_t> sumsOf(std::span<const raster::ItemBuffer> buffers, std::uint32_t largest) {
  std::map<std::uint32_t, std::uint64_t> sums;
  for (const raster::ItemBuffer& buffer : buffers)
    for (std::size_t i = 0; i < buffer.ids.size(); ++i) sums[std::min(buffer.ids[i], largest)] += weightOf(i);
  return sums;
}

/// Whether the renderer, if it sums pixels, finds the sums of the buffers that it draws.
bool areSumsRight(raster::ItemBufferRenderer& renderer, const std::vector<raster::Face>& faces) {
  constexpr std::uint32_t ids = 1 << 16;
  const std::unique_ptr<raster::PixelSums> sums = renderer.makeSums([] {
    return raster::SlotTable{.bits = 16, .backId = ids + 1, .back = ids, .blocks = {{ids, 0}}};
  });
  if (!sums) return true;
  const std::vector<raster::ItemBuffer> buffers = render(renderer, faces);
  std::vector<std::size_t> weights;
  for (const raster::ItemBuffer& buffer : buffers) {
    std::vector<std::uint64_t> before{0};
    for (std::size_t i = 0; i < buffer.ids.size(); ++i) before.push_back(before.back() + weightOf(i));
    weights.push_back(sums->addWeights(before));
  }
  const raster::SummedView view{faces, weights, {}};
  std::map<std::uint32_t, std::uint64_t> found;
  for (const raster::SlotSums& part : sums->sum({&view, 1}))
    for (std::size_t s = 0; s < part.slots.size(); ++s) found[std::min(part.slots[s], ids)] += part.sums[s];
  return found == sumsOf(buffers, ids);
}

Judgement judged(const RowDevice& device) {
  Judgement all;
  for (const TestVector& vector : vectorSuite()) {
    const auto renderer = makeRenderer(vector.list, device.device, device.name);
    const Verdict verdict = judge(vector, render(*renderer, facesOf(vector)), {});
    if (hasErrors(verdict) || !areSumsRight(*renderer, facesOf(vector))) all.wrong.push_back(vector.name);
    const VerdictCounts counts = countVerdicts(verdict);
    for (std::size_t v = 0; v < counts.size(); ++v)
      (static_cast<PixelVerdict>(v) == PixelVerdict::Exact ? all.exact : all.explained) += counts[v];
  }
  return all;
}

/// The folder of judgements; empty if the user has none.
std::filesystem::path recordFolder() {
  if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
    return std::filesystem::path(cache) / "hemitex/devices";
  const char* const home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? std::filesystem::path(home) / ".cache/hemitex/devices"
                                          : std::filesystem::path();
}

std::optional<Judgement> readJudgement(const std::filesystem::path& file) try {
  const std::optional<std::string> text = raster::tryReadFile(file);
  if (!text) return std::nullopt;
  const auto json = ordered_json::parse(*text);
  return Judgement{json.at("exact"), json.at("explained"), json.at("wrong")};
} catch (const ordered_json::exception&) {
  return std::nullopt;
}

/// Replaces the file at once, so that no other process reads a part of it. Without a place for it there is no record.
void writeJudgement(const std::filesystem::path& file, const std::string& device, const Judgement& judgement) {
  const ordered_json json{
      {"device", device}, {"exact", judgement.exact}, {"explained", judgement.explained}, {"wrong", judgement.wrong}};
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  const std::filesystem::path part = file.string() + "." + std::to_string(getpid());
  try {
    raster::writeFile(part, json.dump(2) + "\n");
    std::filesystem::rename(part, file, error);
  } catch (const raster::InputError&) {  // it will be judged again
  }
}

/// The judgement of the renderer of a program, which draws with that device and driver.
Judgement knownOrJudged(const RowDevice& device, const std::string& name, const std::filesystem::path& program,
                        const Tell& tell) {
  const std::string key = std::to_string(static_cast<int>(device.device)) + name + sha256OfFile(program);
  const std::filesystem::path folder = recordFolder(), file = folder / (sha256(key) + ".json");
  if (!folder.empty())
    if (const auto known = readJudgement(file)) return *known;
  tell("judging " + name + " by the test vectors; this takes some seconds, once");
  const Judgement judgement = judged(device);
  if (!folder.empty()) writeJudgement(file, name, judgement);
  return judgement;
}

}  // namespace

RendererMaker judgedRenderers(const RowDevice& device, const std::filesystem::path& program, const Tell& tell) {
  if (device.device == Device::Software)
    return [](raster::DrawList list) { return std::make_unique<raster::SoftwareRenderer>(std::move(list)); };
  const std::string name = deviceName(device.device, device.name);
  const Judgement judgement = knownOrJudged(device, name, program, tell);
  if (!judgement.wrong.empty())
    throw raster::InputError(name + " draws " + std::to_string(judgement.wrong.size()) +
                                 " test vectors wrongly, the first of them `" + judgement.wrong.front() + "`",
                             "use another driver, or the software; docs/backend.md says how to see the pixels");
  tell("rows are drawn by " + name + ", which draws " + std::to_string(judgement.exact) +
       " pixels of the test vectors exactly, and " + std::to_string(judgement.explained) + " as a device may");
  return [device](const raster::DrawList& list) { return makeRenderer(list, device.device, device.name); };
}

}  // namespace hemitex::reference
