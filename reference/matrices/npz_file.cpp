#include "reference/matrices/npz_file.h"

#include <zip.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "radiosity/base/text_lines.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"
#include "raster/base/short_number.h"

namespace hemitex::reference {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are read and written as they are in memory");

const std::string saveAgain = "save the matrix again with scipy.sparse.save_npz";

/// The header of an array in NumPy's `.npy` format, versions 1 to 3. Source: NumPy Enhancement Proposal 1, and the
/// module numpy.lib.format.
struct NpyHeader {
  std::string type;                       ///< NumPy's name, such as `<f8`
  std::vector<std::uint64_t> shape = {};  ///< empty for a single value
};

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t npyHeaderBytes = 128;  ///< of every header that toBytes makes

[[noreturn]] void failHeader(const std::string& file, const std::string& what) {
  throw raster::InputError(file, 0, "has an array that NumPy did not write: " + what, "save the matrix again");
}

/// The text behind a key of the dictionary.
std::string_view valueOf(std::string_view text, const std::string& key, const std::string& file) {
  const std::size_t at = text.find("'" + key + "':");
  if (at == std::string_view::npos) failHeader(file, "its header lacks `" + key + "`");
  text.remove_prefix(at + key.size() + 3);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

/// The text from the start of `text`, which must be `open`, to the next `close`.
std::string_view between(std::string_view text, char open, char close, const std::string& file) {
  const std::size_t end = text.empty() || text.front() != open ? text.npos : text.find(close, 1);
  if (end == std::string_view::npos) failHeader(file, "its header is damaged");
  return text.substr(1, end - 1);
}

/// The bytes of a header, of version 1.
std::string toBytes(const NpyHeader& header) {
  std::string text = "{'descr': '" + header.type + "', 'fortran_order': False, 'shape': (";
  for (const std::uint64_t size : header.shape) text += std::to_string(size) + (header.shape.size() == 1 ? "," : ", ");
  if (header.shape.size() > 1) text.resize(text.size() - 2);
  text += "), }";
  constexpr std::size_t textBytes = npyHeaderBytes - 10;
  text.resize(textBytes - 1, ' ');
  const std::string version{1, 0, static_cast<char>(textBytes), 0};
  return std::string(magic) + version + text + '\n';
}

/// The number of bytes of the header that starts with `start`, which has at least 12 bytes.
std::size_t npyHeaderSize(std::string_view start, const std::string& file) {
  if (!start.starts_with(magic) || start.size() < 12) failHeader(file, "it does not start with the name of the format");
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(start[i])}; };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) failHeader(file, "version " + std::to_string(version) + " of the format is unknown");
  return version == 1 ? 10 + byte(8) + (byte(9) << 8)
                      : 12 + byte(8) + (byte(9) << 8) + (byte(10) << 16) + (byte(11) << 24);
}

/// Parses the bytes of a header. The order of axes is ignored: arrays here have one.
NpyHeader parseNpyHeader(std::string_view bytes, const std::string& file) {
  NpyHeader header;
  header.type = between(valueOf(bytes, "descr", file), '\'', '\'', file);
  std::string sizes(between(valueOf(bytes, "shape", file), '(', ')', file));
  std::replace(sizes.begin(), sizes.end(), ',', ' ');
  std::string_view rest = sizes;
  while (const auto size = radiosity::nextWord(rest)) {
    const auto number = raster::parseInteger<std::uint64_t>(*size);
    if (!number) failHeader(file, "its shape is damaged");
    header.shape.push_back(*number);
  }
  return header;
}

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Archive = std::unique_ptr<zip_t, CloseArchive>;

Archive openForReading(const std::filesystem::path& file) {
  raster::InputFile opened = raster::openFile(file, "check the path, and that it is a file you may read");
  zip_source_t* const source = zip_source_filep_create(opened.get(), 0, -1, nullptr);
  if (source != nullptr) opened.release();  // the source closes it
  Archive archive(source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, nullptr));
  if (archive) return archive;
  if (source != nullptr) zip_source_free(source);
  throw raster::InputError(file.string(), 0, "cannot be read as a ZIP archive", saveAgain);
}

[[noreturn]] void failWriting(const std::filesystem::path& file) {
  throw raster::InputError(file.string(), 0, "cannot be written", "check the disk");
}

/// An array of the archive, whose bytes are read in order.
class Member {
 public:
  Member(zip_t* archive, const std::string& name, const std::filesystem::path& file)
      : name_(file.string() + ": " + name), stream_(zip_fopen(archive, (name + ".npy").c_str(), 0)) {
    zip_stat_t about{};
    if (!stream_ || zip_stat(archive, (name + ".npy").c_str(), 0, &about) != 0)
      fail("is missing in the archive, or cannot be read");
    constexpr std::uint64_t highestRatio = 1032;  // of deflated bytes
    bytes_ = std::min(about.size, raster::saturatedProduct(about.comp_size, highestRatio));
    std::string bytes = read(12);
    const std::size_t size = npyHeaderSize(bytes, name_);
    if (size > maxHeader || size < bytes.size()) fail("its header has " + std::to_string(size) + " bytes");
    bytes += read(size - bytes.size());
    header_ = parseNpyHeader(bytes, name_);
  }

  const NpyHeader& header() const { return header_; }
  /// The number of values of an array with one axis.
  std::uint64_t count() const {
    if (header_.shape.size() != 1) fail("has " + std::to_string(header_.shape.size()) + " axes instead of 1");
    return header_.shape[0];
  }

  /// All values of the array, of the type in the file. Each will need so many bytes elsewhere, too.
  template <typename Value>
  std::vector<Value> values(std::size_t otherBytes = 0) {
    if (count() > bytes_ / sizeof(Value)) fail("ends before its last value");
    raster::requireMemory(raster::saturatedProduct(count(), sizeof(Value) + otherBytes), name_, "the array");
    std::vector<Value> result(count());
    readInto(reinterpret_cast<char*>(result.data()), result.size() * sizeof(Value));
    finish();
    return result;
  }
  /// As above, converted from the type in the file.
  template <typename Value, typename Stored>
  std::vector<Value> converted() {
    if constexpr (std::is_same_v<Value, Stored>) return values<Value>();
    const std::vector<Stored> stored = values<Stored>(sizeof(Value));
    std::vector<Value> result;
    result.reserve(stored.size());
    for (const Stored value : stored) {
      if constexpr (std::is_integral_v<Stored>)
        if (!std::in_range<Value>(value)) fail("has the number " + std::to_string(value));
      result.push_back(static_cast<Value>(value));
    }
    return result;
  }
  template <typename Value>
  std::vector<Value> integers() {
    if (header_.type == "<i4") return converted<Value, std::int32_t>();
    if (header_.type == "<i8") return converted<Value, std::int64_t>();
    if (header_.type == "<u4") return converted<Value, std::uint32_t>();
    if (header_.type == "<u8") return converted<Value, std::uint64_t>();
    fail("has the type " + header_.type + "; integers of 4 or 8 bytes are read");
  }
  std::vector<double> numbers() {
    if (header_.type == "<f8") return converted<double, double>();
    if (header_.type == "<f4") return converted<double, float>();
    fail("has the type " + header_.type + "; floating point of 4 or 8 bytes is read");
  }
  /// A single text, of bytes or of UTF-32, without its padding.
  std::string text() {
    const bool isBytes = header_.type.starts_with("|S"), isWide = header_.type.starts_with("<U");
    constexpr std::size_t longest = 64;
    if ((!isBytes && !isWide) || !header_.shape.empty()) fail("is not a text");
    std::string result;
    for (std::string byte = readSome(1); !byte.empty() && result.size() < longest; byte = readSome(1))
      if (byte[0] != 0) result += byte;
    return result;
  }

  [[noreturn]] void fail(const std::string& what) const { throw raster::InputError(name_, 0, what, saveAgain); }

 private:
  static constexpr std::size_t maxHeader = std::size_t{1} << 16;

  struct Close {
    void operator()(zip_file_t* stream) const { zip_fclose(stream); }
  };

  std::string readSome(std::size_t bytes) {
    std::string result(bytes, 0);
    const zip_int64_t count = zip_fread(stream_.get(), result.data(), bytes);
    if (count < 0) fail("is damaged");
    result.resize(static_cast<std::size_t>(count));
    return result;
  }
  void readInto(char* place, std::size_t bytes) {
    while (bytes > 0) {
      const zip_int64_t count = zip_fread(stream_.get(), place, bytes);
      if (count < 0) fail("is damaged");
      if (count == 0) fail("ends before its last value");
      place += count;
      bytes -= static_cast<std::size_t>(count);
    }
  }
  std::string read(std::size_t bytes) {
    std::string result(bytes, 0);
    readInto(result.data(), bytes);
    return result;
  }
  /// At the end of the member its checksum is compared.
  void finish() {
    if (!readSome(1).empty()) fail("goes on behind its last value");
  }

  std::string name_;
  std::unique_ptr<zip_file_t, Close> stream_;
  std::uint64_t bytes_ = 0;  ///< that the member can have
  NpyHeader header_;
};

std::string bytesOf(const auto& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])};
}

/// An array in a file of its own, whose length is known at its end.
class SpooledArray {
 public:
  SpooledArray(std::filesystem::path file, std::string type, std::size_t valueBytes)
      : file_(std::move(file)), type_(std::move(type)), valueBytes_(valueBytes), stream_(file_, std::ios::binary) {
    stream_ << std::string(npyHeaderBytes, 0);
  }
  void write(const auto& values) {
    stream_.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size() * valueBytes_));
    count_ += values.size();
    if (!stream_) failWriting(file_);
  }
  void finish() {
    stream_.seekp(0);
    stream_ << toBytes({type_, {count_}});
    stream_.close();
    if (!stream_) failWriting(file_);
  }
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::string type_;
  std::size_t valueBytes_;
  std::uint64_t count_ = 0;
  std::ofstream stream_;
};

std::filesystem::path beside(const std::filesystem::path& file, const std::string& ending) {
  return file.string() + ending;
}

class NpzSink : public RowSink {
 public:
  NpzSink(const std::filesystem::path& file, const MatrixHeading& heading)
      : file_(file),
        heading_(heading),
        indices_(beside(file, ".indices"), "<i4", sizeof(std::uint32_t)),
        data_(beside(file, ".data"), "<f8", sizeof(double)) {
    if (heading.hasErrors) error_.emplace(beside(file, ".error"), "<f4", sizeof(float));
  }
  ~NpzSink() override { removeSpools(); }

  /// The order of the members is SciPy's.
  void finish() override {
    indices_.finish();
    data_.finish();
    if (error_) error_->finish();
    archive_.reset(zip_open(file_.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr));
    if (!archive_) failWriting(file_);
    addFile("indices", indices_.file());
    if (rowStart_.back() <= std::numeric_limits<std::int32_t>::max())
      addArray("indptr", "<i4", std::vector<std::int32_t>(rowStart_.begin(), rowStart_.end()));
    else
      addArray("indptr", "<i8", rowStart_);
    addText("format", "csr");
    addArray("shape", "<i8", std::vector<std::uint64_t>{heading_.facets(), heading_.columns()});
    addFile("data", data_.file());
    if (error_) addFile("error", error_->file());
    addArray("area", "<f8", heading_.area);
    addText("about", aboutMatrix(heading_));
    if (zip_close(archive_.get()) != 0) failWriting(file_);
    archive_.release();
    removeSpools();
  }

 private:
  void append(const SparseRow& row) override {
    indices_.write(row.column);
    data_.write(row.value);
    if (error_) error_->write(std::vector<float>(row.error.begin(), row.error.end()));
    rowStart_.push_back(rowStart_.back() + static_cast<std::int64_t>(row.value.size()));
  }
  void removeSpools() const {
    std::error_code ignored;
    for (const SpooledArray* array : {&indices_, &data_}) std::filesystem::remove(array->file(), ignored);
    if (error_) std::filesystem::remove(error_->file(), ignored);
  }
  void addArray(const std::string& name, const std::string& type, const auto& values) {
    addBytes(name, toBytes({type, {values.size()}}) + bytesOf(values));
  }
  void addText(const std::string& name, const std::string& text) {
    addBytes(name, toBytes({"|S" + std::to_string(text.size())}) + text);
  }
  void addBytes(const std::string& name, std::string bytes) {
    members_.push_back(std::make_unique<std::string>(std::move(bytes)));
    add(name, zip_source_buffer(archive_.get(), members_.back()->data(), members_.back()->size(), 0));
  }
  void addFile(const std::string& name, const std::filesystem::path& file) {
    add(name, zip_source_file(archive_.get(), file.c_str(), 0, -1));
  }
  void add(const std::string& name, zip_source_t* source) {
    if (source == nullptr) failWriting(file_);
    const zip_int64_t index = zip_file_add(archive_.get(), (name + ".npy").c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      failWriting(file_);
    }
    const auto member = static_cast<zip_uint64_t>(index);
    constexpr zip_uint16_t firstDay = 1 << 5 | 1;  // 1 January 1980, as NumPy writes
    if (zip_set_file_compression(archive_.get(), member, ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(archive_.get(), member, 0, firstDay, 0) != 0)
      failWriting(file_);
  }
  std::filesystem::path file_;
  MatrixHeading heading_;
  SpooledArray indices_, data_;
  std::optional<SpooledArray> error_;
  std::vector<std::int64_t> rowStart_{0};
  std::vector<std::unique_ptr<std::string>> members_;  ///< libzip reads them when it closes the archive
  Archive archive_;
};

}  // namespace

std::string aboutMatrix(const MatrixHeading& heading) {
  nlohmann::ordered_json about{
      {"content", "form factors: entry (i, j) is the share of the light of facet i that meets facet j"},
      {"facets", heading.facets()},
      {"column_surroundings", heading.facets()},
      {"column_backs", heading.facets() + 1},
      {"surroundings", "share that meets nothing"},
      {"backs", "share that meets backs of facets"}};
  if (heading.hasErrors) about["error"] = "estimated absolute error of each entry of data";
  if (!heading.names.empty()) about["names"] = heading.names;
  return about.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

MatrixFile readNpz(const std::filesystem::path& file) {
  const Archive archive = openForReading(file);
  const auto member = [&](const char* name) { return Member(archive.get(), name, file); };
  const std::string format = member("format").text();
  if (format != "csr")
    throw raster::InputError(file.string(), 0, "has the format `" + raster::excerpt(format) + "`, not csr",
                             "convert the matrix with .tocsr() before it is saved");
  const std::vector<std::uint64_t> shape = member("shape").integers<std::uint64_t>();
  if (shape.size() != 2) member("shape").fail("has " + std::to_string(shape.size()) + " numbers instead of 2");
  MatrixFile result;
  result.matrix = {shape[1], member("indptr").integers<std::uint64_t>(), member("indices").integers<std::uint32_t>(),
                   member("data").numbers()};
  if (result.matrix.rowStart.empty() || result.matrix.rows() != shape[0])
    throw raster::InputError(file.string(), 0,
                             "has " + std::to_string(result.matrix.rowStart.size()) + " starts of rows for " +
                                 std::to_string(shape[0]) + " rows",
                             saveAgain);
  if (zip_name_locate(archive.get(), "error.npy", 0) >= 0) result.matrix.error = member("error").numbers();
  checkAndSort(result.matrix, file.string());
  if (zip_name_locate(archive.get(), "area.npy", 0) >= 0) {
    result.area = member("area").numbers();
    if (result.area.size() != result.matrix.rows())
      member("area").fail("has " + std::to_string(result.area.size()) + " numbers for " +
                          std::to_string(result.matrix.rows()) + " rows");
  }
  return result;
}

std::unique_ptr<RowSink> npzSink(const std::filesystem::path& file, const MatrixHeading& heading) {
  return std::make_unique<NpzSink>(file, heading);
}

}  // namespace hemitex::reference
