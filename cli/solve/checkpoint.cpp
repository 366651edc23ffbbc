#include "cli/solve/checkpoint.h"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>

#include "cli/common/program.h"
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

const std::string title = "hemitex checkpoint 4\n", anyTitle = "hemitex checkpoint ";

/// Makes sure that the bytes of a file are on the disk.
void flush(const fs::path& file) {
  const Descriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!opened.isOpen() || fsync(opened.get()) != 0)
    throw InputError(file.string(), 0, "cannot be written", "make room on the disk");
}

/// Whether a file begins as checkpoints of any version do.
bool isCheckpoint(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string begin(anyTitle.size(), '\0');
  return stream.read(begin.data(), static_cast<std::streamsize>(begin.size())) && begin == anyTitle;
}

/// Removes the number of bytes and then these bytes.
std::string_view takeText(std::string_view& bytes) { return takeBytes(bytes, takeValue<std::uint64_t>(bytes)); }

void appendText(std::string& bytes, const std::string& text) {
  radiosity::appendBytes(bytes, std::uint64_t{text.size()});
  bytes += text;
}

}  // namespace

std::string checkpointBytes(const CheckpointOwner& owner, const std::vector<std::string>& snapshots) {
  std::string content;
  for (const std::string* text : {&owner.version, &owner.scene, &owner.settings}) appendText(content, *text);
  for (const std::string& snapshot : snapshots) appendText(content, snapshot);
  return title + reference::sha256(content) + content;
}

std::vector<std::string> readCheckpoint(std::string_view bytes, const CheckpointOwner& owner) {
  if (!bytes.starts_with(anyTitle)) throw InputError("is not a checkpoint");
  if (!bytes.starts_with(title)) throw InputError("is a checkpoint of another version", "solve without --resume");
  takeBytes(bytes, title.size());
  const std::string_view hash = takeBytes(bytes, reference::sha256Digits);
  if (reference::sha256(bytes) != hash) throw InputError("is damaged");
  if (const std::string_view version = takeText(bytes); version != owner.version)
    throw InputError(
        "is a checkpoint of hemitex " + raster::excerpt(version, 20) + ", and this is hemitex " + owner.version,
        "solve without --resume");
  if (takeText(bytes) != owner.scene) throw InputError("belongs to another scene", "solve without --resume");
  if (takeText(bytes) != owner.settings)
    throw InputError("belongs to other settings", "repeat the options of the run that wrote it");
  std::vector<std::string> snapshots;
  while (!bytes.empty()) snapshots.emplace_back(takeText(bytes));
  return snapshots;
}

Checkpoint::Checkpoint(const LongRunOptions& options, const radiosity::Scene& scene, const std::string& settings,
                       const std::set<fs::path>& inputs)
    : options_(options) {
  if (options.checkpoint.empty() && options.resume.empty()) return;
  owner_ = {programVersion(), hashOf(scene), reference::sha256(settings)};
  if (!options.checkpoint.empty()) {
    Output output{Output::Kind::File, options.checkpoint, solveWriter, inputs};
    output.inputs.erase(options.resume);  // a run that goes on replaces the checkpoint that it began with
    output.isOwn = isCheckpoint;
    staging_.emplace(output);
    staging_->requirePlaces({options.checkpoint.filename()});
  }
  if (!options.resume.empty()) read(options.resume);
  if (staging_) write();  // reports a file that cannot be written before the work
}

std::optional<radiosity::Snapshot> Checkpoint::begin() {
  if (begun_++ >= snapshots_.size()) {
    snapshots_.emplace_back();
    return std::nullopt;
  }
  std::string_view bytes = snapshots_[begun_ - 1];
  if (bytes.empty()) return std::nullopt;
  try {
    radiosity::Snapshot snapshot = radiosity::takeSnapshot(bytes);
    if (!bytes.empty()) throw InputError("is damaged");
    return snapshot;
  } catch (const InputError& error) {
    throw InputError(options_.resume.string(), 0, error.what());
  }
}

void Checkpoint::update(const radiosity::Step& step, bool isStopping) {
  if (!staging_) return;
  const bool isTime = std::chrono::duration<double>(Clock::now() - written_).count() >= options_.every;
  if (!step.isLast && !isTime && !isStopping) return;
  snapshots_[begun_ - 1] = radiosity::toBytes(step.snapshot());
  write();
  written_ = Clock::now();
}

void Checkpoint::read(const fs::path& file) {
  const std::string text = raster::readFile(file, "give a file that --checkpoint has written");
  try {
    snapshots_ = readCheckpoint(text, owner_);
  } catch (const InputError& error) {
    throw InputError(file.string(), 0, error.what());
  }
}

void Checkpoint::write() {
  raster::writeFile(staging_->file(), checkpointBytes(owner_, snapshots_));
  flush(staging_->file());
  staging_->commit();
}

}  // namespace hemitex::cli
