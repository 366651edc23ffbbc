// hemitex solve --report and hemitex view: the page of a solved folder, and the browser that opens it.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "cli/report/solved_page.h"
#include "tests/support/box_scene.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// A line of sh that runs hemitex with other variables of the environment.
std::string withVariables(const std::string& variables, const std::string& arguments) {
  return "env -u BROWSER -u DISPLAY -u WAYLAND_DISPLAY " + variables + " '" HEMITEX_PROGRAM "' " + arguments;
}

/// The JSON of a page's element.
json elementOf(const std::string& page, const std::string& id) {
  const std::string start = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t begin = page.find(start) + start.size();
  REQUIRE(begin >= start.size());
  return json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// A page without its element of times.
std::string withoutTimesOfPage(const std::string& page) {
  const std::size_t begin = page.find("<script type=\"application/json\" id=\"times\">");
  REQUIRE(begin != std::string::npos);
  return page.substr(0, begin) + page.substr(page.find('\n', begin));
}

}  // namespace

TEST_CASE("hemitex solve --report writes the same page for any number of threads, except for times", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--report -o one --threads 1");
  shell.output(quickSolve + "--report -o two --threads 2");
  const std::string page = readAll(shell.file("one/report.html"));
  CHECK(withoutTimesOfPage(page) == withoutTimesOfPage(readAll(shell.file("two/report.html"))));

  const json shown = elementOf(page, "result"), solution = solutionOf(shell, "one");
  for (const char* key : {"settings", "elements", "shots", "residual", "energy", "warnings"})
    CHECK(shown[key] == solution[key]);
  REQUIRE(shown["surfaces"].size() == 6);
  for (std::size_t s = 0; s < 6; ++s)
    for (const char* key : {"name", "area", "elements", "radiosity", "reflectance", "emission"})
      CHECK(shown["surfaces"][s][key] == solution["surfaces"][s][key]);
  CHECK(shown["convergence"]["shots"].back() == solution["shots"]);
  CHECK(shown["convergence"]["residual"].back() == solution["residual"]);
  const json seconds = elementOf(page, "times")["shots_s"];
  CHECK(seconds.size() == shown["convergence"]["shots"].size());
  CHECK(std::is_sorted(seconds.begin(), seconds.end()));
}

TEST_CASE("hemitex solve writes the means of each surface, which add up to the flux of its elements", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "-o out");
  const json solution = solutionOf(shell, "out");
  double flux = 0, emitted = 0, ofElements = 0;
  for (const json& surface : solution["surfaces"]) {
    const double area = surface["area"], radiosity = surface["radiosity"][2], emission = surface["emission"][2];
    flux += area * radiosity;
    emitted += area * emission;
    const bool isLamp = surface["name"] == "ceiling/lamp";
    for (std::size_t band = 0; band < 3; ++band)
      CHECK(surface["reflectance"][band].get<double>() == Approx(isLamp ? 0 : std::array{0.7, 0.5, 0.3}[band]));
  }
  for (const std::string& line : linesOf(readAll(shell.file("out/elements.csv"))))
    if (!line.ends_with("b_b")) {
      const std::string before = line.substr(0, line.rfind(',', line.rfind(',', line.rfind(',') - 1) - 1));
      ofElements += lastNumber(before) * lastNumber(line);
    }
  CHECK(flux == Approx(ofElements).epsilon(1e-12));
  CHECK(emitted == Approx(solution["energy"]["emitted"][2].get<double>()).epsilon(1e-12));
}

TEST_CASE("hemitex solve --report names the surfaces whose backs absorb light", "[cli]") {
  const Shell shell;
  // A sheet in the middle of the room, whose back is seen by the ceiling, which emits.
  writeAll(shell.file("sheet.obj"), std::regex_replace(readAll(shell.file("room.obj")), std::regex("usemtl lamp"),
                                                       "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\n"
                                                       "v 0 -0.5 -0.5\nv 0 0.5 -0.5\nv 0 0.5 0.5\nv 0 -0.5 0.5\n"
                                                       "g sheet\nf 13 14 15 16\nusemtl lamp"));
  std::string command = quickSolve;
  command.replace(command.find("room.obj"), 8, "sheet.obj");
  shell.output(command + "--one-sided --report -o out");
  const json shown = elementOf(readAll(shell.file("out/report.html")), "result");
  REQUIRE(shown["backs"]["absorbed_by"].size() == 1);
  const json& back = shown["backs"]["absorbed_by"][0];
  CHECK(shown["surfaces"][back["surface"].get<std::size_t>()]["name"] == "sheet");
  double seen = 0;
  for (const json& from : shown["backs"]["seen_from"]) seen += from["flux"][0].get<double>();
  const double lost = shown["energy"]["lost_to_backs"][0];
  CHECK(lost > 0);
  CHECK(seen == Approx(lost).epsilon(1e-12));
  CHECK(back["flux"][0].get<double>() == Approx(lost).epsilon(1e-9));
}

TEST_CASE("hemitex solve without --report removes the page of an earlier solution", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--report -o out");
  CHECK(fs::exists(shell.file("out/report.html")));
  shell.output(quickSolve + "-o out");
  CHECK_FALSE(fs::exists(shell.file("out/report.html")));
}

TEST_CASE("hemitex solve ends with elements, shots, time, residual, expected error and files", "[cli]") {
  const Shell shell;
  const std::string text = shell.output(quickSolve + "--report -o out");
  for (const char* line : {"6 surfaces, 96 elements, \\d+ patches\n",
                           "\\d+ shots in [0-9.e-]+ s, 0\\.0\\d+ % of the emitted flux unshot\n",
                           "picture: +out/render.png\n", "numbers: +out/solution.json\n", "page: +out/report.html\n"})
    CHECK(std::regex_search(text, std::regex(line)));
  CHECK(text.find("expected error") == std::string::npos);
  CHECK(shell.output(quickSolve + "-o out").find("report.html") == std::string::npos);
  CHECK(std::regex_search(shell.output("solve room.obj --texels 4 --size 40x30 --max-error 0.2 -o out"),
                          std::regex("expected error: [0-9.]+ % of all flux\n"
                                     " +[0-9.]+ % of the flux of the surfaces that the camera sees\n")));
  const Outcome quiet = shell.run(quickSolve + "-q -o out");
  CHECK(quiet.out.empty());
  CHECK(quiet.err.empty());
  const json solution = json::parse(shell.output(quickSolve + "-q --json -o out"));
  CHECK(solution["elements"] == 96);
  CHECK(solution["expected_error"].is_null());
  CHECK(solution["expected_error_seen"].is_null());
}

TEST_CASE("hemitex view starts $BROWSER with the page and prints its path", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--report -o out");
  writeAll(shell.file("browser"), "#!/bin/sh\nprintf '%s\\n' \"$@\" >\"$(dirname \"$0\")/opened\"\n");
  fs::permissions(shell.file("browser"), fs::perms::owner_all);
  const auto [command, before] = GENERATE(table<std::string, std::string>({
      {"$PWD/browser", ""},
      {"no-such-browser:$PWD/browser --new %s", "--new\n"},
      {"false:$PWD/browser", ""},
  }));
  const Outcome outcome = shell.execute(withVariables("BROWSER=\"" + command + "\"", "view out"));
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.out == "out/report.html\n");
  CHECK(outcome.err.empty());
  CHECK(readAll(shell.file("opened")) == before + shell.file("out/report.html").string() + "\n");
}

TEST_CASE("hemitex view starts a browser in which no signal is blocked or ignored that hemitex handles", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--report -o out");
  writeAll(shell.file("browser"),
           "#!/bin/sh\ngrep -E '^Sig(Blk|Ign)' /proc/self/status >\"$(dirname \"$0\")/signals\"\n");
  fs::permissions(shell.file("browser"), fs::perms::owner_all);
  CHECK(shell.execute(withVariables("BROWSER=\"$PWD/browser\"", "view out")).exitCode == 0);
  const std::vector<std::string> lines = linesOf(readAll(shell.file("signals")));
  REQUIRE(lines.size() == 2);
  for (const std::string& line : lines)
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) {
      INFO(line << ", signal " << signal);
      CHECK((std::stoull(line.substr(line.find('\t')), nullptr, 16) >> (signal - 1) & 1) == 0);
    }
}

TEST_CASE("hemitex view says that the user must open the page where no browser can", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--report -o out");
  const auto [variables, message] = GENERATE(table<std::string, std::string>({
      {"", "there is no display and no $BROWSER"},
      {"BROWSER=no-such-browser", "no browser could be started (no-such-browser)"},
  }));
  const Outcome outcome = shell.execute(withVariables(variables, "view out"));
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.out == "out/report.html\n");
  CHECK(outcome.err.find(message) != std::string::npos);
  const json told = json::parse(shell.execute(withVariables(variables, "view out --json")).out);
  CHECK(told == json({{"page", "out/report.html"}, {"opened", false}}));
}

TEST_CASE("hemitex view makes the page of a solved folder that has none, without the curve", "[cli]") {
  const Shell shell;
  shell.output(quickSolve + "--report -o with");
  shell.output(quickSolve + "-o without");
  CHECK(shell.execute(withVariables("", "view without")).exitCode == 0);
  const json made = elementOf(readAll(shell.file("without/report.html")), "result"),
             solved = elementOf(readAll(shell.file("with/report.html")), "result");
  CHECK_FALSE(made.contains("convergence"));
  for (const char* key : {"surfaces", "energy", "settings", "room"}) CHECK(made[key] == solved[key]);
}

TEST_CASE("solvedPage holds scene.glb in base64, and says if there is none", "[cli]") {
  const Shell shell;
  const hemitex::radiosity::Scene scene = closedCube(glm::dvec3(0.5), glm::dvec3(1));
  const std::vector<std::uint32_t> surfaceOf{0, 0, 1, 1, 2, 2};
  const nlohmann::ordered_json surface{{"name", "wall"}, {"area", 1}},
      solution{{"surfaces", {surface, surface, surface}}, {"times", {{"solve_s", 1}}}};
  const auto pageOf = [&] { return hemitex::cli::solvedPage({shell.file("scene.glb"), scene, surfaceOf}, solution); };
  CHECK(elementOf(pageOf(), "result")["room"]["glb"] == "missing");
  writeAll(shell.file("scene.glb"), "glTF");
  const json room = elementOf(pageOf(), "result")["room"];
  CHECK(room["glb"] == "shown");
  CHECK(room["parts"] == json::parse(R"([[[0, 2], [0, 2], [1, 2], [1, 2], [2, 2], [2, 2]]])"));
  CHECK(pageOf().find(R"(id="glb">Z2xURg==</script>)") != std::string::npos);
}

TEST_CASE("hemitex view refuses a folder that is not solved, with an advice and exit code 2", "[cli]") {
  const Shell shell;
  fs::create_directory(shell.file("empty"));
  shell.output(quickSolve + "-o mixed");
  writeAll(shell.file("mixed/solution.json"), R"({"surfaces": [{"name": "floor"}], "times": {"solve_s": 1}})");
  for (const char* folder : {"empty", "none", "mixed"}) {
    const auto before = shell.files();
    const Outcome outcome = shell.execute(withVariables("", std::string("view ") + folder));
    INFO(folder << '\n' << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK(outcome.err.find("--report") != std::string::npos);
    CHECK(shell.files() == before);
  }
}
