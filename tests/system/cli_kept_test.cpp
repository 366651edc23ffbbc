/// What an unfinished run keeps for a later one, rows and checkpoints, is checked as any input.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/base/hashes/sha256.h"
#include "tests/support/shell.h"

using namespace hemitex::tests;
using Catch::Matchers::Contains;
using hemitex::reference::sha256;
using nlohmann::json;

namespace {

const std::string matrix = "formfactors room.obj --all --facets --texels 8 --resolution 512 --threads 1 -o F.npz";

std::string withHash(const std::string& text) { return text + ' ' + sha256(text) + '\n'; }

/// A run that was killed when it had some rows. On a busy machine it may end first: then it begins anew.
struct KilledMatrix {
  Shell shell;
  std::vector<std::string> lines;  ///< of the file of rows, without their hashes

  KilledMatrix() {
    shell.execute("for try in $(seq 20); do\n" + program + matrix +
                  " & run=$!\nwhile kill -0 $run && ! [ \"$(wc -l <F.npz.part)\" -ge 4 ]\ndo sleep 0.01\ndone "
                  "2>/dev/null\nkill -KILL $run\nwait $run\n[ -e F.npz ] || break\nrm -f F.npz F.json\ndone");
    for (const std::string& line : linesOf(readAll(shell.file("F.npz.part"))))
      if (line.size() > 65) lines.push_back(line.substr(0, line.size() - 65));
    REQUIRE(lines.size() >= 4);
  }

  /// Goes on with other lines, whose hashes are right.
  Outcome goOn(const std::vector<std::string>& changed) const {
    std::string text;
    for (const std::string& line : changed) text += withHash(line);
    writeAll(shell.file("F.npz.part"), text);
    return shell.run(matrix);
  }
};

}  // namespace

TEST_CASE("Rows of an unfinished matrix that no run wrote are computed again", "[kept]") {
  const KilledMatrix killed;
  Shell whole;
  whole.output(matrix);
  const std::string right = readAll(whole.file("F.npz"));
  const std::string number = killed.lines[2].substr(0, 2);
  const json row = json::parse(killed.lines[2].substr(2));
  const auto changed = [&](const std::function<void(json&)>& change) {
    json other = row;
    change(other);
    return number + other.dump();
  };
  const std::vector<std::string> damaged{
      changed([](json& r) { r[0][0] = 4000000000u; }),
      changed([](json& r) { r[0].back() = 8; }),
      changed([](json& r) { r[0][0] = -1; }),
      changed([](json& r) { r[0][0] = 0.5; }),
      changed([](json& r) { std::swap(r[0][0], r[0][1]); }),
      changed([](json& r) { r[0][1] = r[0][0]; }),
      changed([](json& r) { r[1].erase(0); }),
      changed([](json& r) { r[1][0] = -0.5; }),
      changed([](json& r) { r[1][0] = 1e300; }),
      changed([](json& r) { r[1][0] = "0.1"; }),
      changed([](json& r) { r[1][0] = nullptr; }),
      changed([](json& r) { r[1][0] = r[1][0].get<double>() + 0.01; }),
      changed([](json& r) { r[2] = "../x"; }),
      changed([](json& r) { r[2] = json::array({0.1}); }),
      changed([](json& r) { r[3] = "x"; }),
      changed([](json& r) { r[3] = -1; }),
      changed([](json& r) { r.push_back(0); }),
      changed([](json& r) { r.erase(3); }),
      changed([](json& r) {
        r[0].erase(r[0].size() - 2);  // surroundings without backs
        r[1].erase(r[1].size() - 2);
      }),
      changed([](json& r) { r = json::object(); }),
      number + row.dump().replace(2, 1, "NaN"),
      number + "[[],[],[],NaN]",
      number,
      row.dump(),
      "7 " + row.dump(),
      killed.lines[1],
  };
  for (const std::string& line : damaged) {
    INFO(line.substr(0, 200));
    std::vector<std::string> lines = killed.lines;
    lines[2] = line;
    const Outcome outcome = killed.goOn(lines);
    INFO(outcome.err);
    CHECK(outcome.exitCode == 0);
    CHECK_THAT(outcome.err, Contains("row 1 of the unfinished result is damaged") && Contains("goes on after 1 rows"));
    CHECK(readAll(killed.shell.file("F.npz")) == right);
    killed.shell.execute("rm F.npz F.json");
  }
}

TEST_CASE("More rows than the matrix has are dropped", "[kept]") {
  const KilledMatrix killed;
  killed.shell.output(matrix);
  const std::string right = readAll(killed.shell.file("F.npz"));
  killed.shell.execute("rm F.npz F.json");
  std::vector<std::string> lines(killed.lines.begin(), killed.lines.begin() + 3);
  for (int row = 2; row < 9; ++row) lines.push_back(std::to_string(row) + killed.lines[2].substr(1));
  const Outcome outcome = killed.goOn(lines);
  CHECK(outcome.exitCode == 0);
  CHECK_THAT(outcome.err, Contains("row 6 of the unfinished result is damaged"));
}

TEST_CASE("Rows of another version of hemitex are refused by its name", "[kept]") {
  const KilledMatrix killed;
  std::vector<std::string> lines = killed.lines;
  REQUIRE_THAT(lines[0], Contains(HEMITEX_VERSION));
  lines[0].replace(lines[0].find(HEMITEX_VERSION), std::string(HEMITEX_VERSION).size(), "0.0.7");
  const Outcome outcome = killed.goOn(lines);
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err,
             Contains("F.npz.part:1: the rows are of hemitex 0.0.7, and this is hemitex " HEMITEX_VERSION));
  CHECK_FALSE(killed.shell.files().contains("F.npz"));
  for (const std::string heading : {"", "hemitex rows 3 ", "0a 0b"}) {
    lines[0] = heading;
    const Outcome other = killed.goOn(lines);
    CHECK(other.exitCode == 2);
    CHECK_THAT(other.err, Contains("F.npz.part:1: "));
  }
}

namespace {

const std::string small = "solve room.obj --texels 4 --patch 2 --resolution 32 --shots 9 --size 40x30 -o out ";
const std::string title = "hemitex checkpoint 4\n";

/// The content of a checkpoint behind its hash: texts with their lengths.
std::vector<std::string> textsOf(const std::string& bytes) {
  std::vector<std::string> texts;
  for (std::size_t at = title.size() + 64; at < bytes.size();) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at, sizeof size);
    texts.push_back(bytes.substr(at + sizeof size, size));
    at += sizeof size + size;
  }
  return texts;
}

std::string checkpointOf(const std::vector<std::string>& texts) {
  std::string content;
  for (const std::string& text : texts) {
    const std::uint64_t size = text.size();
    content.append(reinterpret_cast<const char*>(&size), sizeof size);
    content += text;
  }
  return title + sha256(content) + content;
}

}  // namespace

TEST_CASE("A checkpoint with a right hash and wrong content is refused in one line", "[kept]") {
  const Shell shell;
  shell.output(small + "--checkpoint c");
  const std::vector<std::string> right = textsOf(readAll(shell.file("c")));
  REQUIRE(right.size() == 4);
  REQUIRE(right[0] == HEMITEX_VERSION);
  REQUIRE(checkpointOf(right) == readAll(shell.file("c")));
  const auto refused = [&](const std::vector<std::string>& texts, const std::string& reason) {
    writeAll(shell.file("c"), checkpointOf(texts));
    const Outcome outcome = shell.run(small + "--resume c");
    INFO(outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains(reason));
    CHECK(linesOf(outcome.err).size() == 1);
  };
  refused({"0.0.7", right[1], right[2], right[3]}, "c: is a checkpoint of hemitex 0.0.7, and this is hemitex");
  refused({right[0], right[2], right[2], right[3]}, "c: belongs to another scene");
  refused({right[0], right[1], right[1], right[3]}, "c: belongs to other settings");
  refused({right[0], right[1], right[2], right[3] + "x"}, "c: is damaged");
  refused({right[0], right[1], right[2], right[3].substr(0, 40)}, "c: is cut off");
  // Numbers of the snapshot, from its end: the flux of patches and elements.
  const auto withNumber = [&](std::size_t fromEnd, double number) {
    std::vector<std::string> texts = right;
    std::memcpy(texts[3].data() + texts[3].size() - fromEnd, &number, sizeof number);
    return texts;
  };
  for (const double number : {-1.0, 1e300, std::nan(""), HUGE_VAL, 12.0})
    for (const std::size_t fromEnd : {56, 120, 200, 400, 1200})
      refused(withNumber(fromEnd, number), "does not balance");
  writeAll(shell.file("c"), "hemitex checkpoint 2\nold");
  CHECK_THAT(shell.run(small + "--resume c").err, Contains("c: is a checkpoint of another version"));
}
