#include "reference/base/json_text.h"

#include <set>
#include <vector>

namespace hemitex::reference {
namespace {

using nlohmann::json;

/// Visits the parts of a text in order.
class Check final : public nlohmann::json_sax<json> {
 public:
  explicit Check(std::string file) : file_(std::move(file)) {}

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    if (!keys_.back().insert(key).second) fail("an object has this key twice: " + shortText(json(key)));
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const json::exception& error) override {
    fail(error.what());
    return false;
  }

 private:
  bool open() {
    keys_.emplace_back();
    if (keys_.size() > maxJsonDepth) fail("values are nested too deeply");
    return true;
  }
  bool close() {
    keys_.pop_back();
    return true;
  }
  [[noreturn]] void fail(const std::string& what) const {
    if (file_.empty()) throw raster::InputError(what);
    throw raster::InputError(file_, 0, what);
  }

  std::string file_;
  std::vector<std::set<std::string>> keys_;  ///< of the open objects; empty for arrays
};

}  // namespace

void checkJson(const std::string& text, const std::string& file) {
  Check check(file);
  json::sax_parse(text, &check);
}

}  // namespace hemitex::reference
