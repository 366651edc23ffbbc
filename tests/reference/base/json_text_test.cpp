#include "reference/base/json_text.h"

#include <catch2/catch.hpp>
#include <string>

#include "raster/base/input_error.h"

using namespace hemitex;
using namespace hemitex::reference;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Lists within lists.
std::string nested(int depth) {
  return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
}

}  // namespace

TEST_CASE("parseJson gives what the parser gives for JSON without doubled keys", "[json]") {
  const auto text = GENERATE(as<std::string>{}, "1", "[]", R"({"a": {"a": [1, {"a": 2}]}, "b": [{"a": 1}, {"a": 1}]})",
                             R"("\u00e9")", nested(maxJsonDepth));
  CHECK(parseJson<json>(text) == json::parse(text));
}

TEST_CASE("parseJson refuses deep nesting, doubled keys and other text, with the file's name", "[json]") {
  CHECK_THROWS_WITH(parseJson<json>(nested(maxJsonDepth + 1)), Contains("nested too deeply"));
  CHECK_THROWS_WITH(parseJson<json>(nested(10000000), "deep.json"), Contains("deep.json") && Contains("nested"));
  CHECK_THROWS_WITH(parseJson<json>(std::string(10000000, '[')), Contains("nested too deeply"));
  CHECK_THROWS_WITH(parseJson<json>(R"([{"a": 1, "b": 2, "a": 3}])"), Contains(R"(this key twice: "a")"));
  const auto text = GENERATE(as<std::string>{}, "", "{", "[1,]", "nul", "\x80", R"({"a" 1})");
  CHECK_THROWS_AS(parseJson<json>(text), raster::InputError);
}

TEST_CASE("vectorAt reads three numbers and nothing else", "[json]") {
  CHECK(vectorAt(json::parse(R"({"by": [1, 2.5, -3]})"), "by") == glm::dvec3(1, 2.5, -3));
  const auto text = GENERATE(as<std::string>{}, R"({})", R"({"by": [1, 2]})", R"({"by": [1, 2, 3, 4]})",
                             R"({"by": [1, 2, "3"]})", R"({"by": 1})", R"({"by": {"x": 1, "y": 2, "z": 3}})");
  CHECK_THROWS_WITH(vectorAt(json::parse(text), "by"), Contains("a list of three numbers"));
}

TEST_CASE("Messages show at most the beginning of a long value", "[json]") {
  CHECK(shortText(json::parse("[1, 2]")) == "[1,2]");
  CHECK(shortText(json(std::string(100000, 'x'))).size() < 110);
}
