/// hemitex matrix: judges and compares the matrices that formfactors writes.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "reference/matrices/matrix_files.h"
#include "tests/support/shell.h"

using namespace hemitex::tests;
using nlohmann::json;

namespace {

/// What a foreign program printed of a matrix: a line with its numbers of rows, columns and entries, then its entries.
void checkPrinted(const std::string& text, const hemitex::reference::SparseMatrix& matrix) {
  const std::vector<std::string> lines = linesOf(text);
  REQUIRE(lines.size() == matrix.value.size() + 1);
  CHECK(lines.front().ends_with(std::to_string(matrix.rows()) + " " + std::to_string(matrix.columns) + " " +
                                std::to_string(matrix.value.size())));
  std::size_t k = 0;
  for (std::size_t row = 0; row < matrix.rows(); ++row)
    for (; k < matrix.rowStart[row + 1]; ++k) {
      std::istringstream words(lines[k + 1]);
      std::size_t foundRow = 0, column = 0;
      std::string value;
      words >> foundRow >> column >> value;
      CHECK((foundRow == row && column == matrix.column[k] && std::stod(value) == matrix.value[k]));
    }
}

}  // namespace

TEST_CASE("hemitex matrix check accepts a matrix of formfactors, and names the fault of a spoiled one", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.01 -o F.csv");
  CHECK(shell.output("matrix check F.csv room.obj").find("nothing wrong was found") != std::string::npos);

  // All walls of the cube have one area, so that the true matrix is symmetric; percent are not.
  shell.execute("awk -F, -v OFS=, 'NR > 1 && $2 ~ /^[0-9]+$/ {$3 = 100 * $3} {print}' F.csv > percent.csv");
  const Outcome outcome = shell.run("matrix check percent.csv room.obj");
  CHECK(outcome.exitCode == 1);
  CHECK(outcome.out.find("fault: entries are in percent") != std::string::npos);
  const json verdict = json::parse(shell.run("matrix check percent.csv room.obj --json").out);
  CHECK(verdict["fault"] == "entries are in percent");
  CHECK(verdict["problems"].size() >= 2);
}

TEST_CASE("hemitex formfactors tells the rows that miss --max-error, and fails if the user insists", "[cli]") {
  const Shell shell;
  // A small triangle between a floor and a roof.
  writeAll(shell.file("m.obj"),
           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
           "v .3 .3 .5\nv .7 .35 .5\nv .6 .7 .5\n"
           "f 1 2 3 4\nf 5 6 7 8\nf 9 10 11\n");
  const std::string command = "formfactors m.obj --all --facets --one-sided -o F.npz --max-error ";
  const Outcome strict = shell.run(command + "1e-7");
  CHECK(strict.exitCode == 0);
  CHECK(strict.err.find("above --max-error") != std::string::npos);
  const json told = json::parse(readAll(shell.file("F.json")));
  for (const std::size_t row : told["rows_above"]) CHECK(told["errors"][row] > 1e-7);
  CHECK(told["rows_above"].size() >= 2);
  CHECK(shell.run(command + "1e-7 --insist").exitCode == 1);
  const Outcome easy = shell.run(command + "0.9 --insist");
  CHECK(easy.exitCode == 0);
  CHECK(easy.err.find("above --max-error") == std::string::npos);
  CHECK(json::parse(readAll(shell.file("F.json")))["rows_above"].empty());
}

TEST_CASE("hemitex matrix check and compare refuse what is no matrix of the mesh", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.02 -o F.npz");
  for (const char* arguments : {"check room.mtl room.obj", "check missing.npz room.obj", "check F.npz missing.obj",
                                "compare F.npz missing.npz room.obj"}) {
    CAPTURE(arguments);
    const Outcome outcome = shell.run("matrix " + std::string(arguments));
    CHECK(outcome.exitCode == 2);
    CHECK_FALSE(outcome.err.empty());
  }
}

TEST_CASE("hemitex matrix compare of a matrix with itself is 0, and of two methods small", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.01 -o a.npz");
  shell.output("formfactors room.obj --all --facets --method rays -o b.npz");
  CHECK(json::parse(shell.output("matrix compare a.npz a.npz room.obj --json"))["difference"] == 0);
  const json difference = json::parse(shell.output("matrix compare a.npz b.npz room.obj --json"));
  CHECK(difference["difference"] > 0);
  CHECK(difference["difference"] < 0.01);
  CHECK(difference["facets"].size() == 6);
}

TEST_CASE("hemitex matrix smooth repairs reciprocity and sums of rows, and tells leaks of a closed mesh", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.01 -o F.csv");
  // One entry is spoiled, and the row of facet 0 leaks. All walls of the cube have one area.
  shell.execute(
      "awk -F, -v OFS=, '$1 == 1 && $2 == 2 {$3 *= 1.2} {print} END {print 0, \"surroundings\", 0.1}' F.csv > G.csv");
  for (const char* file : {"a.npz", "b.csv", "c.mtx"}) {
    const json told = json::parse(shell.output("matrix smooth G.csv room.obj --json -o " + std::string(file)));
    CHECK(told["leaks"].size() == 1);
    CHECK(told["leaks"][0]["facet"] == 0);
    CHECK(told["rows_missed"].empty());
    const hemitex::reference::SparseMatrix matrix = hemitex::reference::readMatrix(shell.file(file)).matrix;
    for (std::uint32_t i = 0; i < 6; ++i) {
      double sum = 0;
      for (std::uint32_t j = 0; j < 6; ++j) {
        const auto there = matrix.placeOf(i, j), back = matrix.placeOf(j, i);
        REQUIRE(there.has_value() == back.has_value());
        if (there) sum += matrix.value[*there];
        if (there) CHECK(std::abs(matrix.value[*there] - matrix.value[*back]) < 1e-12);
      }
      CHECK(std::abs(sum - 1) < 1e-9);
    }
  }
  CHECK(shell.run("matrix smooth G.csv room.obj -o d.txt").exitCode == 2);
  CHECK(shell.run("matrix smooth G.csv room.obj").exitCode == 2);
}

TEST_CASE("SciPy and Octave read the same matrices from .npz, .mtx and .csv", "[cli]") {
  const Shell shell;
  const std::string box = HEMITEX_DATA "/cornell-box.obj --all --facets --max-error 0.05 -o ";
  for (const char* file : {"F.npz", "F.mtx", "F.csv"}) shell.output("formfactors " + box + file);
  const hemitex::reference::SparseMatrix matrix = hemitex::reference::readMatrix(shell.file("F.npz")).matrix;
  const auto check = [&](const std::string& needed, const std::string& reading) {
    if (shell.execute(needed).exitCode != 0) {
      WARN("skipped: `" + needed + "` fails, so that nothing is read with it");
      return;
    }
    const Outcome outcome = shell.execute(reading);
    INFO(reading << outcome.err);
    REQUIRE(outcome.exitCode == 0);
    checkPrinted(outcome.out, matrix);
  };
  for (const std::string file : {"F.npz", "F.mtx"})
    check("/usr/bin/python3 -c 'import scipy'",
          "/usr/bin/python3 " HEMITEX_SOURCE "/tests/viewers/read_matrix.py " + file);
  for (const std::string file : {"F.mtx", "F.csv"})
    check("command -v octave-cli", "octave-cli --norc " HEMITEX_SOURCE "/tests/viewers/read_matrix.m " + file);
}
