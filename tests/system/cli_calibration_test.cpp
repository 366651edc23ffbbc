/// hemitex vector calibrate, and the suggestion of hemitex vector check to use it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reference/conformance/calibration/probes.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/injected_faults.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Writes what a device draws into one folder per vector.
void draw(const SimulatedDevice& device, const std::vector<reference::TestVector>& vectors, const fs::path& folder) {
  for (const reference::TestVector& vector : vectors) {
    fs::create_directories(folder / vector.name);
    reference::writeCandidate(folder / vector.name, vector, drawAll(device, vector));
  }
}

}  // namespace

TEST_CASE("hemitex vector calibrate finds the profile of the reference renderer, and none of a device that fits none",
          "[cli]") {
  const Shell shell;
  const json vectors = json::parse(shell.output("vector calibrate --probes probes --json"))["vectors"];
  CHECK(vectors.size() >= 10);
  for (const json& vector : vectors) {
    const std::string name = vector["name"];
    CHECK_FALSE(fs::exists(shell.file("probes/" + name + "/front.u32")));
    shell.output("vector render probes/" + name + " -o device/" + name);
  }
  const std::string calibrate = "vector calibrate probes --candidate device -o profile.json";
  const json found = json::parse(shell.output(calibrate + " --html page.html --device-name 'A <GPU>' --json"));
  const std::string page = readAll(shell.file("page.html"));
  CHECK_THAT(page, Catch::Contains("<h1>Profile of A &lt;GPU&gt;</h1>"));
  for (const char* property : {"Sub-pixel grid", "Edge rule", "Texel addressing", "Depth", "Clipping"})
    CHECK_THAT(page, Catch::Contains(std::string("<h2>") + property + "</h2>"));
  CHECK_THAT(page, Catch::Contains("8 bits, to the nearest") && !Catch::Contains("src=") && !Catch::Contains("href="));
  CHECK(found["faults"].empty());
  CHECK(found["profile"] == json::parse(readAll(shell.file("profile.json"))));
  CHECK(found["profile"]["version"] == 2);
  CHECK(found["profile"]["subpixel_bits"] == 8);
  CHECK(found["profile"]["snap_rounding"] == "nearest");
  CHECK(found["profile"]["edge_rule"] == "top-left");
  CHECK(linesOf(shell.output(calibrate)).at(3) == "subpixel_bits,8");
  shell.output("vector check device/edge-rule --candidate device/edge-rule --profile profile.json");

  fs::remove(shell.file("profile.json"));
  fs::remove(shell.file("page.html"));
  writeAll(shell.file("device/edge-rule/front.u32"), std::string(256 * 4, 'x'));
  const Outcome faulty = shell.run(calibrate + " --html page.html");
  CHECK_FALSE(fs::exists(shell.file("page.html")));
  CHECK(faulty.exitCode == 1);
  CHECK(faulty.out.find("coverage: ") == 0);
  CHECK_FALSE(fs::exists(shell.file("profile.json")));

  fs::remove(shell.file("device/edge-rule/front.u32"));
  CHECK(shell.run(calibrate).exitCode == 2);
  fs::copy(shell.file("probes/snapping-5/positions.f32"), shell.file("probes/snapping-4/positions.f32"),
           fs::copy_options::overwrite_existing);
  const Outcome strange = shell.run(calibrate);
  CHECK(strange.exitCode == 2);
  CHECK(strange.err.find("--probes") != std::string::npos);
  for (const char* arguments :
       {"", " probes", " probes -o profile.json", " probes --candidate device",
        " --probes again probes --candidate device -o profile.json", " --probes again -o out",
        " --probes again --html page.html", " probes --candidate device -o p.json --device-name a"})
    CHECK(shell.run(std::string("vector calibrate") + arguments).exitCode == 2);
  CHECK_FALSE(fs::exists(shell.file("again")));
}

TEST_CASE("hemitex vector check suggests the class of a device without a profile, and calibrate measures it", "[cli]") {
  // A plain device: 4 sub-pixel bits, interpolation in binary32.
  SimulatedDevice device;
  device.profile = {.subpixelBits = 4, .texelPrecision = 0};
  device.interpolation = Interpolation::Planes32;
  const Shell shell;
  shell.output("vector suite -o suite");
  shell.output("vector calibrate --probes probes");
  draw(device, reference::vectorSuite(), shell.file("drawn"));
  draw(device, vectorsOf(reference::makeProbes()), shell.file("answers"));
  for (const fs::directory_entry& folder : fs::directory_iterator(shell.file("suite")))
    if (!fs::exists(shell.file("drawn") / folder.path().filename())) fs::remove_all(folder);

  const std::string check = "vector check suite --candidate drawn";
  const Outcome first = shell.run(check);
  CHECK(first.exitCode == 1);
  const json results = json::parse(shell.run(check + " --json").out);
  const json& suggestion = results["suggestion"];
  CHECK(suggestion["device"] == "4 sub-pixel bits");
  CHECK(suggestion["errors"] == results["pixels"]["error"]);
  CHECK(suggestion["explained"] == suggestion["errors"]);
  CHECK(suggestion["profile"]["subpixel_bits"] == 4);
  CHECK(std::string(suggestion["advice"]).find("hemitex vector calibrate --probes") != std::string::npos);
  const std::string errors = std::to_string(int(suggestion["errors"]));
  CHECK(first.out.find("suggestion: " + errors + " of " + errors + " errors fit a device with 4 sub-pixel bits; ") !=
        std::string::npos);

  shell.output("vector calibrate probes --candidate answers -o profile.json");
  CHECK(json::parse(readAll(shell.file("profile.json")))["subpixel_bits"] == 4);
  const json calibrated = json::parse(shell.output(check + " --profile profile.json --json"));
  CHECK(calibrated["pixels"]["error"] == 0);
  CHECK(calibrated["suggestion"].is_null());

  // One vector by itself, and a device without errors.
  const Outcome single = shell.run("vector check suite/two-by-two --candidate drawn/two-by-two --json");
  CHECK(json::parse(single.out).contains("suggestion"));
  const json right = json::parse(shell.output("vector check suite --candidate suite --json"));
  CHECK(right["suggestion"].is_null());
  CHECK(shell.output("vector check suite --candidate suite").find("suggestion") == std::string::npos);
}
