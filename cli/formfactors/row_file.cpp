#include "cli/formfactors/row_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "cli/common/json.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

using nlohmann::json;
using raster::InputError;

const std::string title = "hemitex rows 3 ";
const char* const advice = "delete it, or choose another file";

/// A line without the hash at its end; nothing if it is damaged.
std::optional<std::string_view> withoutHash(std::string_view line) {
  if (line.size() <= reference::sha256Digits) return std::nullopt;
  const std::string_view text = line.substr(0, line.size() - reference::sha256Digits - 1);
  return line.substr(text.size()) == " " + reference::sha256(text) ? std::optional(text) : std::nullopt;
}

std::string withHash(const std::string& text) { return text + ' ' + reference::sha256(text) + '\n'; }

/// The first line of a file of rows.
std::string headingOf(const Computation& computation) {
  return withHash(title + computation.version + ' ' + computation.hash);
}

constexpr double rounding = 1e-6;

bool isShare(double value) { return std::isfinite(value) && value >= -rounding; }

bool isValid(const reference::SparseRow& row, std::size_t receivers) {
  const std::vector<std::uint32_t>& column = row.column;
  if (std::adjacent_find(column.begin(), column.end(), std::greater_equal<>()) != column.end()) return false;
  if (row.value.size() != column.size() || (!row.error.empty() && row.error.size() != column.size())) return false;
  if (!column.empty() && column.back() > receivers + 1) return false;
  const bool hasBlockers = row.placeOf(receivers).has_value();
  const double shares = std::accumulate(row.value.begin(), row.value.end(), 0.0);
  if (hasBlockers != row.placeOf(receivers + 1).has_value() || (hasBlockers && !(std::abs(shares - 1) <= rounding)))
    return false;
  return std::all_of(row.value.begin(), row.value.end() - (hasBlockers ? 2 : 0), isShare) &&
         std::all_of(row.error.begin(), row.error.end(), isShare) && isShare(row.rowError.value_or(0));
}

/// Whether a value is a list of integers that are row numbers: others would be converted without a word.
bool areNumbers(const json& list) {
  return list.is_array() && std::all_of(list.begin(), list.end(), [](const json& value) {
           return value.is_number_unsigned() && value.get<std::uint64_t>() <= 0xFFFFFFFF;
         });
}

}  // namespace

std::string lineOf(const reference::SparseRow& row) {
  return json{row.column, row.value, row.error, orNull(row.rowError)}.dump();
}

std::optional<reference::SparseRow> rowOf(std::string_view line) {
  const json list = json::parse(line, nullptr, false);
  if (!list.is_array() || list.size() != 4 || !areNumbers(list[0])) return std::nullopt;
  try {
    reference::SparseRow row{list[0].get<std::vector<std::uint32_t>>(), list[1].get<std::vector<double>>(),
                             list[2].get<std::vector<double>>()};
    if (!list[3].is_null()) row.rowError = list[3].get<double>();
    return row;
  } catch (const json::exception&) {  // a value of another type
    return std::nullopt;
  }
}

std::string numberedLine(std::size_t number, const std::string& row) {
  return withHash(std::to_string(number) + ' ' + row);
}

std::optional<reference::SparseRow> numberedRow(std::string_view line, std::size_t number, std::size_t receivers) {
  const std::string prefix = std::to_string(number) + ' ';
  const std::optional<std::string_view> text = withoutHash(line);
  if (!text || !text->starts_with(prefix) || number >= receivers) return std::nullopt;
  std::optional<reference::SparseRow> row = rowOf(text->substr(prefix.size()));
  if (row && !isValid(*row, receivers)) row.reset();
  return row;
}

RowFile::RowFile(const Output& output, const Computation& computation, const std::set<std::string>& companions)
    : staging_(output), part_(output.place.filename().string() + ".part"), file_(nullptr, std::fclose) {
  std::set<std::string> names = companions;
  names.insert(output.place.filename());
  staging_.requirePlaces(names);
  const Folder& folder = staging_.place();
  const std::string path = folder.pathOf(part_).string();
  if (const auto kind = folder.placeOf(part_).kind; kind != Place::Kind::Nothing && kind != Place::Kind::File)
    throw InputError(path, 0, "is in the way: rows are kept in a file of this name", advice);
  const Descriptor opened = folder.open(part_, O_RDWR | O_CREAT);
  file_.reset(opened.isOpen() ? fdopen(dup(opened.get()), "r+b") : nullptr);
  if (!file_) throw InputError(path, 0, "cannot be written", advice);
  const std::string heading = headingOf(computation), line = nextLine(), known = title + computation.version + ' ';
  if (line.starts_with(title) && line.ends_with('\n') && !line.starts_with(known)) {
    const std::string version = line.substr(title.size(), line.find(' ', title.size()) - title.size());
    throw InputError(
        path, 1,
        "the rows are of hemitex " + raster::excerpt(version, 20) + ", and this is hemitex " + computation.version,
        advice);
  }
  // A run that ended while it wrote the first line leaves a part of it.
  if (!heading.starts_with(line))
    throw InputError(path, 1, "the rows belong to another scene or other settings", advice);
  if (line == heading) return;
  try {
    cutFrom(0);
    write(heading);
  } catch (const InputError&) {
    folder.remove(part_);  // it has no rows
    throw;
  }
}

/// The next line, with its end if it is complete.
std::string RowFile::nextLine() {
  char* text = nullptr;
  std::size_t capacity = 0;
  const ssize_t size = getline(&text, &capacity, file_.get());
  const std::unique_ptr<char, void (*)(void*)> owner(text, [](void* bytes) { std::free(bytes); });
  return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : std::string();
}

/// Drops what the file holds from a place on, and goes there.
void RowFile::cutFrom(long place) {
  if (std::fseek(file_.get(), place, SEEK_SET) != 0 || ftruncate(fileno(file_.get()), place) != 0)
    throw InputError(staging_.place().pathOf(part_).string(), 0, "cannot be written", advice);
}

bool RowFile::replay(std::size_t receivers, const std::function<void(reference::SparseRow)>& take) {
  for (;; ++rows_) {
    const long place = std::ftell(file_.get());
    std::string line = nextLine();
    const bool isComplete = line.ends_with('\n');
    if (isComplete) line.pop_back();
    std::optional<reference::SparseRow> row;
    if (isComplete) row = numberedRow(line, rows_, receivers);
    if (!row) {
      cutFrom(place);
      return !line.empty() || isComplete;
    }
    take(std::move(*row));
  }
}

void RowFile::reread(std::size_t receivers, const std::function<void(reference::SparseRow)>& take) {
  std::rewind(file_.get());
  nextLine();
  for (std::size_t number = 0; number < rows_; ++number) {
    std::string line = nextLine();
    if (line.ends_with('\n')) line.pop_back();
    std::optional<reference::SparseRow> row = numberedRow(line, number, receivers);
    if (!row)
      throw InputError(staging_.place().pathOf(part_).string(), static_cast<int>(number + 2),
                       "was changed while it was written", "run the command again");
    take(std::move(*row));
  }
}

void RowFile::write(const std::string& line) {
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    throw InputError(staging_.place().pathOf(part_).string(), 0, "cannot be written",
                     "check the disk; the complete rows are kept");
}

void RowFile::append(const reference::SparseRow& row) { write(numberedLine(rows_++, lineOf(row))); }

void RowFile::finish(const std::string& last) {
  staging_.commit(last);
  staging_.place().remove(part_);
}

}  // namespace hemitex::cli
