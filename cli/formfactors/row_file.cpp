#include "cli/formfactors/row_file.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "cli/common/text_hash.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

using nlohmann::json;

/// A line of the file, without its hash; nothing if it is incomplete or damaged.
std::optional<std::string> intactLine(std::string_view text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || end < hashDigits + 1) return std::nullopt;
  const std::string_view line = text.substr(0, end - hashDigits - 1);
  if (text.substr(line.size(), hashDigits + 1) != " " + hashText(line)) return std::nullopt;
  return std::string(line);
}

std::string withHash(const std::string& line) { return line + ' ' + hashText(line) + '\n'; }

json toJson(const std::optional<double>& value) { return value ? json(*value) : json(); }

std::optional<double> numberIn(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

}  // namespace

std::string lineOf(const Row& row) {
  return json{row.formFactor, row.standardError, toJson(row.background), toJson(row.back), toJson(row.captured)}.dump();
}

Row rowOf(const std::string& line) {
  const json row = json::parse(line);
  return {row[0].get<std::vector<double>>(), row[1].get<std::vector<double>>(), numberIn(row[2]), numberIn(row[3]),
          numberIn(row[4])};
}

/// Drops the tail of a file that is not intact.
RowFile::RowFile(const std::filesystem::path& output, const std::string& computation)
    : output_(output), part_(output.string() + ".part") {
  const std::string advice = "delete it, or choose another file";
  if (std::filesystem::is_directory(output)) throw raster::InputError(output.string(), 0, "is a folder", advice);
  const std::string text = std::filesystem::exists(part_) ? raster::readFile(part_, advice) : "";
  const std::optional<std::string> found = intactLine(text);
  if (found ? *found != computation : text.find('\n') != std::string::npos)
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
  stream_.open(part_, std::ios::binary | std::ios::app);
}

void RowFile::append(const std::string& line) {
  if (!(stream_ << withHash(line)).flush())
    throw raster::InputError(part_.string(), 0, "cannot be written", "check the disk; the complete rows are kept");
}

void RowFile::finish(const std::string& result) {
  const std::filesystem::path complete = output_.string() + ".new";
  raster::writeFile(complete, result);
  std::filesystem::rename(complete, output_);
  stream_.close();
  std::filesystem::remove(part_);
}

}  // namespace hemitex::cli
