#include "cli/solve/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include "cli/scene/scene_hash.h"
#include "radiosity/base/bytes.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using radiosity::takeBytes;
using radiosity::takeValue;
using raster::InputError;

const std::string title = "hemitex checkpoint 2\n";

/// Makes sure that the bytes of a file are on the disk.
void flush(const fs::path& file) {
  const int opened = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const bool isFlushed = opened >= 0 && fsync(opened) == 0;
  if (opened >= 0) close(opened);
  if (!isFlushed) throw InputError(file.string(), 0, "cannot be written", "make room on the disk");
}

}  // namespace

Checkpoint::Checkpoint(const LongRunOptions& options, const radiosity::Scene& scene, const std::string& settings)
    : options_(options) {
  if (options.checkpoint.empty() && options.resume.empty()) return;
  scene_ = hashOf(scene);
  settings_ = reference::sha256(settings);
  if (!options.resume.empty()) read(options.resume);
  if (!options.checkpoint.empty()) write();  // reports a file that cannot be written before the work
}

std::optional<radiosity::Snapshot> Checkpoint::begin() {
  if (begun_++ >= snapshots_.size()) {
    snapshots_.emplace_back();
    return std::nullopt;
  }
  std::string_view bytes = snapshots_[begun_ - 1];
  if (bytes.empty()) return std::nullopt;
  return radiosity::takeSnapshot(bytes);
}

void Checkpoint::update(const radiosity::Step& step, bool isStopping) {
  if (options_.checkpoint.empty()) return;
  const bool isTime = std::chrono::duration<double>(Clock::now() - written_).count() >= options_.every;
  if (!step.isLast && !isTime && !isStopping) return;
  snapshots_[begun_ - 1] = radiosity::toBytes(step.snapshot());
  write();
  written_ = Clock::now();
}

void Checkpoint::read(const fs::path& file) {
  const std::string text = raster::readFile(file, "give a file that --checkpoint has written");
  try {
    std::string_view rest = text;
    if (!rest.starts_with(title)) throw InputError("is not a checkpoint of this version");
    takeBytes(rest, title.size());
    const std::string_view hash = takeBytes(rest, reference::sha256Digits);
    if (reference::sha256(rest) != hash) throw InputError("is damaged");
    if (takeBytes(rest, reference::sha256Digits) != scene_)
      throw InputError("belongs to another scene", "solve without --resume");
    if (takeBytes(rest, reference::sha256Digits) != settings_)
      throw InputError("belongs to other settings", "repeat the options of the run that wrote it");
    while (!rest.empty()) snapshots_.emplace_back(takeBytes(rest, takeValue<std::uint64_t>(rest)));
  } catch (const InputError& error) {
    throw InputError(file.string(), 0, error.what());
  }
}

void Checkpoint::write() const {
  std::string content = scene_ + settings_;
  for (const std::string& snapshot : snapshots_) {
    radiosity::appendBytes(content, std::uint64_t{snapshot.size()});
    content += snapshot;
  }
  const fs::path partial = options_.checkpoint.string() + ".partial";
  raster::writeFile(partial, title + reference::sha256(content) + content);
  flush(partial);
  std::error_code error;
  fs::rename(partial, options_.checkpoint, error);
  if (!error) return;
  fs::remove(partial);
  throw InputError(options_.checkpoint.string(), 0, "cannot be written: " + error.message(), "choose another file");
}

}  // namespace hemitex::cli
