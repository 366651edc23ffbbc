// Tables of JSON objects, as CSV and as Markdown.
#include "cli/common/table.h"

#include <catch2/catch.hpp>
#include <sstream>

using namespace hemitex::cli;
using nlohmann::ordered_json;

namespace {

const ordered_json records{
    {{"scene", "room"}, {"bytes", {{"rows", 12345.6}, {"elements", 7}}}, {"rounds", {1, 2, 3}}},
    {{"scene", "a,b"}, {"front", true}, {"rounds", ordered_json()}, {"bytes", {{"rows", 0.12345}}}}};

}  // namespace

TEST_CASE("tableOf has a column for every key, inner keys included, in the order in which they appear", "[table]") {
  std::ostringstream csv;
  writeCsv(csv, tableOf(records));
  CHECK(csv.str() ==
        "scene,bytes rows,bytes elements,rounds,front\n"
        "room,12345.6,7,3,\n"
        "\"a,b\",0.12345,,none,1\n");
  CHECK(tableOf(ordered_json{{"one", 1}}).size == 1);
}

TEST_CASE("writeMarkdown rounds to three digits, but keeps all before the point, and leaves out empty tables",
          "[table]") {
  std::ostringstream text;
  writeMarkdown(text, "Nothing:", ordered_json::array());
  writeMarkdown(text, "Nothing:", ordered_json::object());
  writeMarkdown(text, "Bytes:", {{{"rows", 12345.6}}, {{"rows", -1234.5}}, {{"rows", 0.12345}}, {{"rows", 12345}}});
  CHECK(text.str() == "Bytes:\n\n| rows |\n| --- |\n| 12346 |\n| -1235 |\n| 0.123 |\n| 12345 |\n\n");
}
