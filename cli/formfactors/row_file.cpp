#include "cli/formfactors/row_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "cli/common/json.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

using nlohmann::json;

const std::string advice = "delete it, or choose another file";

/// A line of the file, without its hash; nothing if it is incomplete or damaged.
std::optional<std::string> intactLine(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || end < reference::sha256Digits + 1) return std::nullopt;
  const std::string_view line = text.substr(0, end - reference::sha256Digits - 1);
  if (text.substr(line.size(), reference::sha256Digits + 1) != " " + reference::sha256(line)) return std::nullopt;
  return std::string(line);
}

std::string withHash(const std::string& line) { return line + ' ' + reference::sha256(line) + '\n'; }

std::optional<double> numberIn(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

}  // namespace

std::string lineOf(const Row& row) {
  return json{row.formFactor, row.standardError, orNull(row.background), orNull(row.back), orNull(row.captured)}.dump();
}

Row rowOf(const std::string& line) {
  const json row = json::parse(line);
  return {row[0].get<std::vector<double>>(), row[1].get<std::vector<double>>(), numberIn(row[2]), numberIn(row[3]),
          numberIn(row[4])};
}

RowFile::RowFile(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                 const std::string& computation)
    : staging_(std::filesystem::absolute(output).parent_path(), FolderUse::SeveralRuns),
      name_(output.filename()),
      part_(output.string() + ".part") {
  staging_.requirePlaces({name_, part_.filename()}, {inputs.begin(), inputs.end()});
  lock();
  read(computation);
  stream_.open(part_, std::ios::binary | std::ios::app);
}

RowFile::~RowFile() {
  if (lock_ >= 0) close(lock_);
}

/// Holds the file of rows against other runs.
void RowFile::lock() {
  lock_ = open(part_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock_ < 0) throw raster::InputError(part_.string(), 0, "cannot be written", advice);
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0)
    throw raster::InputError(part_.string(), 0, "is in use: another run writes its rows there",
                             "wait for it, or choose another file");
}

/// Reads the rows of an earlier run. Drops the tail of a file that is not intact.
void RowFile::read(const std::string& computation) {
  const std::string text = raster::readFile(part_, advice);
  const std::optional<std::string> found = intactLine(text);
  // A run that ended while it wrote the first line leaves a part of it.
  if (found ? *found != computation : !withHash(computation).starts_with(text))
    throw raster::InputError(part_.string(), 1, "the rows belong to another scene or other settings", advice);
  std::size_t intact = 0;
  if (found) {
    intact = withHash(computation).size();
    while (const auto line = intactLine(std::string_view(text).substr(intact))) {
      intact += withHash(*line).size();
      rows_.push_back(*line);
    }
    std::filesystem::resize_file(part_, intact);
  } else {
    raster::writeFile(part_, withHash(computation));
  }
  wasDamaged_ = intact < text.size();
}

void RowFile::append(const std::string& line) {
  if (!(stream_ << withHash(line)).flush())
    throw raster::InputError(part_.string(), 0, "cannot be written", "check the disk; the complete rows are kept");
}

void RowFile::finish(const std::string& result) {
  raster::writeFile(staging_.folder() / name_, result);
  staging_.commit();
  stream_.close();
  std::filesystem::remove(part_);
}

}  // namespace hemitex::cli
