#include "cli/formfactors/row_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "cli/common/json.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

using nlohmann::json;

const std::string advice = "delete it, or choose another file";

/// A line of the file, without its hash; nothing if it is damaged.
std::optional<std::string> intactLine(const std::string& text) {
  if (text.size() < reference::sha256Digits + 1) return std::nullopt;
  std::string line = text.substr(0, text.size() - reference::sha256Digits - 1);
  if (text.substr(line.size()) != " " + reference::sha256(line)) return std::nullopt;
  return line;
}

std::string withHash(const std::string& line) { return line + ' ' + reference::sha256(line) + '\n'; }

std::optional<double> numberIn(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

}  // namespace

std::string lineOf(const reference::Row& row) {
  return json{row.receiver,        row.formFactor, row.standardError,    orNull(row.background), orNull(row.back),
              row.backgroundError, row.backError,  orNull(row.captured), orNull(row.error)}
      .dump();
}

reference::Row rowOf(const std::string& line) {
  const json row = json::parse(line);
  return {row[0].get<std::vector<std::uint32_t>>(),
          row[1].get<std::vector<double>>(),
          row[2].get<std::vector<double>>(),
          numberIn(row[3]),
          numberIn(row[4]),
          row[5].get<double>(),
          row[6].get<double>(),
          numberIn(row[7]),
          numberIn(row[8])};
}

RowFile::RowFile(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
                 const std::string& computation, const std::set<std::string>& companions)
    : staging_(std::filesystem::absolute(output).parent_path(), FolderUse::SeveralRuns),
      name_(output.filename()),
      part_(output.string() + ".part") {
  std::set<std::string> names = companions;
  names.insert({name_, part_.filename()});
  staging_.requirePlaces(names, {inputs.begin(), inputs.end()});
  lock();
  findIntactRows(computation);
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

/// Counts the rows of an earlier run. Drops the tail of a file that is not intact.
void RowFile::findIntactRows(const std::string& computation) {
  std::ifstream stream(part_, std::ios::binary);
  if (!stream) throw raster::InputError(part_.string(), 0, "cannot be read", advice);
  std::string text;
  // The last line is incomplete if it has no end.
  const auto next = [&] { return std::getline(stream, text) && !stream.eof() ? intactLine(text) : std::nullopt; };
  const std::optional<std::string> found = next();
  // A run that ended while it wrote the first line leaves a part of it.
  if (found ? *found != computation : !stream.eof() || !withHash(computation).starts_with(text))
    throw raster::InputError(part_.string(), 1, "the rows belong to another scene or other settings", advice);
  std::uintmax_t intact = found ? withHash(computation).size() : 0;
  while (found && next()) {
    ++rows_;
    intact += text.size() + 1;
  }
  stream.close();
  wasDamaged_ = intact < std::filesystem::file_size(part_);
  if (found)
    std::filesystem::resize_file(part_, intact);
  else
    raster::writeFile(part_, withHash(computation));
}

void RowFile::replay(const std::function<void(const std::string& line)>& take) {
  std::ifstream stream(part_, std::ios::binary);
  std::string text;
  std::getline(stream, text);  // the computation
  for (std::size_t row = 0; row < rows_ && std::getline(stream, text); ++row) take(*intactLine(text));
}

void RowFile::append(const std::string& line) {
  if (!(stream_ << withHash(line)).flush())
    throw raster::InputError(part_.string(), 0, "cannot be written", "check the disk; the complete rows are kept");
}

void RowFile::finish(const std::string& last) {
  staging_.commit(last);
  stream_.close();
  std::filesystem::remove(part_);
}

}  // namespace hemitex::cli
