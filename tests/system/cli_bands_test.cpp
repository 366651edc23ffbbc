/// Spectral bands: `hemitex solve --bands`, and spectra in MTL files.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "radiosity/images/image.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex::tests;
using nlohmann::json;

namespace {

const std::string box = HEMITEX_DATA "/cornell-box.obj";
const std::string quick = "solve " + box + " --texels 6 --resolution 32 --size 40x30 ";

/// The reflectances and the emission of cornell-box.mtl at three wavelengths.
const std::string rgbOfBox = R"({"wavelengths": [450, 550, 650],
 "materials": {
  "white": {"reflectance": [0.7507, 0.7354, 0.7386]},
  "red": {"reflectance": [0.0117, 0.0359, 0.4507]},
  "green": {"reflectance": [0.0235, 0.3831, 0.1184]},
  "light": {"reflectance": 0.78, "emission": [2.7716, 10.8612, 20.7307]}}})";

}  // namespace

TEST_CASE("hemitex solve --bands with three bands has the bits of the solution without it", "[cli]") {
  const Shell shell;
  writeAll(shell.file("three.json"), rgbOfBox);
  writeAll(shell.file("three.csv"),
           "# The same as CSV.\nmaterial,quantity,450,550,650\nwhite, reflectance, 0.7507,0.7354,0.7386\n"
           "red,reflectance,0.0117,0.0359,0.4507\ngreen,reflectance,0.0235,0.3831,0.1184\n\n"
           "light,reflectance,0.78,0.78,0.78\nlight,emission,2.7716,10.8612,20.7307\r\n");
  shell.output(quick + "-o rgb");
  shell.output(quick + "-o json --bands three.json");
  shell.output(quick + "-o csv --bands three.csv");
  for (const std::string folder : {"json", "csv"}) {
    CHECK(columnOf(shell, folder, "b_650") == columnOf(shell, "rgb", "b_r"));
    CHECK(columnOf(shell, folder, "b_550") == columnOf(shell, "rgb", "b_g"));
    CHECK(columnOf(shell, folder, "b_450") == columnOf(shell, "rgb", "b_b"));
    const json rgb = solutionOf(shell, "rgb"), bands = solutionOf(shell, folder);
    CHECK(bands["bands"] == json({450, 550, 650}));
    CHECK(bands["shots"] == rgb["shots"]);
    CHECK(bands["residual"] == rgb["residual"]);
    for (const char* flux : {"emitted", "absorbed", "unshot", "lost"})
      for (std::size_t band = 0; band < 3; ++band) CHECK(bands["energy"][flux][band] == rgb["energy"][flux][2 - band]);
  }
}

// The reflectances of cornell-box.mtl come from the same spectra, for light that is reflected once: the floor of this
// scene sees only a lamp that reflects nothing. They come from steps of 4 nm, and the bands are 10 nm apart, so that
// reflectances differ by up to 0.004.
TEST_CASE("hemitex solve --bands shows the measured spectra of the Cornell box in the colours of its MTL file",
          "[cli]") {
  const Shell shell;
  writeAll(shell.file("once.obj"),
           "mtllib once.mtl\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 0 1\nv 1 0 1\nv 2 0 1\nv 3 0 1\n"
           "v 0 1 0\nv 3 1 0\nv 3 1 1\nv 0 1 1\nusemtl white\ng white\nf 1 5 6 2\nusemtl red\ng red\nf 2 6 7 3\n"
           "usemtl green\ng green\nf 3 7 8 4\nusemtl light\ng light\nf 9 10 11 12\n");
  const std::string paints = readAll(HEMITEX_DATA "/cornell-box.mtl");
  writeAll(shell.file("once.mtl"), std::regex_replace(paints, std::regex("Kd 0.78 0.78 0.78"), "Kd 0 0 0"));
  const std::string spectra = readAll(HEMITEX_DATA "/cornell-box.bands.csv");
  writeAll(shell.file("once.csv"), std::regex_replace(spectra, std::regex("\nlight,reflectance,[^\n]*"), ""));
  shell.output("solve once.obj --texels 6 --resolution 32 --size 40x30 -o rgb");
  shell.output("solve once.obj --texels 6 --resolution 32 --size 40x30 -o spectra --bands once.csv");
  const json rgb = solutionOf(shell, "rgb"), bands = solutionOf(shell, "spectra");
  CHECK(bands["bands"].size() == 31);
  CHECK(bands["energy"]["absorbed"].size() == 31);
  REQUIRE(rgb["surfaces"][0]["name"] == "white");
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      INFO(rgb["surfaces"][s]["name"] << ' ' << channel);
      const auto of = [&](const json& solution, std::size_t surface) {
        return solution["surfaces"][surface]["radiosity"][channel].get<double>();
      };
      const double ofReflectance1 = of(rgb, 0) / 0.74;  // the white paint's, within 2 %
      CHECK(of(bands, s) == Approx(of(rgb, s)).margin(0.005 * ofReflectance1).epsilon(0));
    }
}

TEST_CASE("hemitex solve --bands writes a column and a channel per band, and the account of each band closes",
          "[cli]") {
  const Shell shell;
  writeAll(shell.file("bands.json"), R"({"wavelengths": [400, 450.5, 500, 900]})");
  const Outcome outcome = shell.run(quick + "-o out --bands bands.json");
  REQUIRE(outcome.exitCode == 0);
  CHECK_THAT(outcome.err, Catch::Contains("materials without a spectrum, whose colours stand for thirds of the bands: "
                                          "white"));
  CHECK_THAT(outcome.out, Catch::Contains("all bands  of emitted"));
  for (const std::string name : {"b_400", "b_450.5", "b_500", "b_900"}) {
    CHECK(columnOf(shell, "out", name).size() > 100);
    CHECK(readAll(shell.file("out/floor.exr")).find(name + '\0') != std::string::npos);
  }
  // One colour stands for both.
  CHECK(columnOf(shell, "out", "b_400").front() != columnOf(shell, "out", "b_500").front());
  const json energy = solutionOf(shell, "out")["energy"];
  for (std::size_t band = 0; band < 4; ++band) {
    const auto flux = [&](const char* name) { return energy[name][band].get<double>(); };
    CHECK(flux("absorbed") + flux("unshot") + flux("lost") == Approx(flux("emitted")).epsilon(1e-9));
    CHECK(flux("emitted") > 0);
  }
  // As colour, the channels R, G and B of the texture are the columns b_r, b_g and b_b.
  const auto pixels = hemitex::radiosity::readImage(shell.file("out/light.exr")).pixels;
  CHECK(pixels.front().r > 0);
}

TEST_CASE("hemitex solve --bands gives six bands what two solutions with three bands give", "[cli]") {
  const Shell shell;
  const std::string materials =
      R"("materials": {"light": {"emission": "bulb.rfl"}, "white": {"reflectance": "white.rfl"}}})";
  writeAll(shell.file("bulb.rfl"), "400 1\n700 4\n");
  writeAll(shell.file("white.rfl"), "400 0.2\n550 0.8\n700 0.5\n");
  writeAll(shell.file("six.json"), R"({"wavelengths": [410, 430, 450, 600, 620, 640], )" + materials);
  writeAll(shell.file("short.json"), R"({"wavelengths": [410, 430, 450], )" + materials);
  writeAll(shell.file("long.json"), R"({"wavelengths": [600, 620, 640], )" + materials);
  // Without splits all have the same patches. Then only the residual differs.
  for (const std::string name : {"six", "short", "long"})
    shell.output(quick + "--split 1 --residual 1e-9 -o " + name + " --bands " + name + ".json");
  shell.output(quick + "--split 1 --residual 1e-9 -o again --bands six.json --threads 1 --row-cache 0");
  CHECK(readAll(shell.file("again/elements.csv")) == readAll(shell.file("six/elements.csv")));
  const auto compare = [&](const std::string& folder, const std::string& band) {
    const std::vector<std::string> a = columnOf(shell, "six", band), b = columnOf(shell, folder, band);
    for (std::size_t e = 0; e < a.size(); ++e) CHECK(std::stod(a[e]) == Approx(std::stod(b[e])).epsilon(1e-6));
  };
  for (const std::string band : {"b_410", "b_430", "b_450"}) compare("short", band);
  for (const std::string band : {"b_600", "b_620", "b_640"}) compare("long", band);
}

TEST_CASE("hemitex solve --bands treats light of options as colours of its bands", "[cli]") {
  const Shell shell;
  writeAll(shell.file("bands.json"), R"({"wavelengths": [420, 430, 440, 450, 610, 620]})");
  shell.output(quick + "-o out --bands bands.json --emit light=1,0,2 --reflectance wall-back=0,0,0 --sky 0,0,1");
  const json solution = solutionOf(shell, "out");
  const json& emitted = solution["energy"]["emitted"];
  CHECK(emitted[0] == emitted[3]);
  CHECK(emitted[4] == emitted[5]);
  CHECK(emitted[0].get<double>() > emitted[4].get<double>());
  for (const json& surface : solution["surfaces"])
    if (surface["name"] == "wall-back") CHECK(surface["radiosity"] == json({0.0, 0.0, 0.0}));
}

TEST_CASE("hemitex solve --bands refuses a wrong file in one line with the place, and writes nothing", "[cli]") {
  struct Bad {
    std::string file, text, what;
  };
  const auto [file, text, what] = GENERATE(values<Bad>({
      {"b.json", "{\"wavelengths\": [450, 550],\n\"materials\": {\n\"white\": {\"reflectance\": [0.5]}}}",
       "b.json:3: `reflectance` of `white` has 1 values for 2 bands"},
      {"b.json", "{\"wavelengths\": [550,\n 450]}", "b.json:1: the wavelength 450 is not above the one before"},
      {"b.json", R"({"wavelengths": [450, 450]})", "the wavelength 450 is not above the one before"},
      {"b.json", R"({"wavelengths": [-1]})", "the wavelength -1 is not above 0"},
      {"b.json", R"({"wavelengths": []})", "there is no wavelength"},
      {"b.json", R"({"materials": {}})", "`wavelengths` is no list of numbers"},
      {"b.json", R"({"wavelengths": [450], "materials": {"whte": {"reflectance": 0.5}}})",
       "the scene has no material `whte`; similar names: `white`"},
      {"b.json", "{\"wavelengths\": [450],\n\"materials\":\n{\"white\": {\"reflectance\": 1}}}",
       "b.json:3: `reflectance` of `white` is not below 1: 1"},
      {"b.json", R"({"wavelengths": [450], "materials": {"white": {"reflectance": -0.5}}})", "is negative: -0.5"},
      {"b.json", R"({"wavelengths": [450], "materials": {"white": {"colour": 0.5}}})", "`colour` is no quantity"},
      {"b.json", R"({"wavelengths": [450], "materials": {"light": {"emission": 1e31}}})", "is above 1e30"},
      {"b.json", R"({"wavelengths": [450], "materials": {"light": {"emission": "no.rfl"}}})", "no.rfl"},
      {"b.json", R"({"wavelengths": [450], "materials": {"light": {"emission": [null]}}})", "write a list of numbers"},
      {"b.json", R"({"wavelengths": [450], "material": {}})",
       "b.json:1: `material` is not known here; similar keys: `materials`"},
      {"b.json", R"({"wavelengths": [450], "materials": {"light": {"emission": 0}}})", "nothing in the scene emits"},
      {"b.json", R"({"wavelengths": [450)", "b.json"},
      {"b.json", "[]", "is no JSON object"},
      {"b.csv", "material,quantity,450\nwhite,reflectance,0.5,0.6\n", "b.csv:2: `reflectance` of `white` has 2 values"},
      {"b.csv", "material,quantity,450\nwhite,reflectance,x\n", "b.csv:2: `x` is no finite number"},
      {"b.csv", "material,quantity,450\nwhite,reflectance,nan\n", "b.csv:2: `nan` is no finite number"},
      {"b.csv", "material,quantity,450\nwhite,reflectance\n", "b.csv:2: is no line of values"},
      {"b.csv", "material,quantity,450\nwhite,emission,1\nwhite,emission,1\n",
       "b.csv:3: `emission` of `white` is given twice"},
      {"b.csv", "white,reflectance,0.5\n", "b.csv:1: is no header of bands"},
      {"b.csv", "material,quantity,450\nmaterial,quantity,450\n", "b.csv:2: is no line of values"},
      {"b.csv", "", "has no bands"},
      {"missing.json", "", "missing.json"},
  }));
  INFO(text);
  const Shell shell;
  if (file != "missing.json") writeAll(shell.file(file), text);
  const Outcome outcome = shell.run(quick + "-o out --bands " + file);
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Catch::Contains(what));
  CHECK(linesOf(outcome.err).size() == 1);
  CHECK_FALSE(std::filesystem::exists(shell.file("out")));
}

TEST_CASE("hemitex solve --bands goes on from a checkpoint with the same bits", "[cli]") {
  const Shell shell;
  writeAll(shell.file("bands.json"), R"({"wavelengths": [450, 550, 600, 650]})");
  shell.output(quick + "-o whole --bands bands.json");
  shell.output(quick + "-o kept --bands bands.json --checkpoint c");
  shell.output(quick + "-o resumed --bands bands.json --resume c");
  for (const std::string folder : {"kept", "resumed"}) {
    CHECK(readAll(shell.file(folder + "/elements.csv")) == readAll(shell.file("whole/elements.csv")));
    CHECK(solutionOf(shell, folder)["energy"] == solutionOf(shell, "whole")["energy"]);
  }
  writeAll(shell.file("bands.json"), R"({"wavelengths": [450, 550, 650]})");
  CHECK(shell.run(quick + "-o other --bands bands.json --resume c").exitCode == 2);
}

TEST_CASE("hemitex solve --bands follows edits, whose colours stand for bands", "[cli]") {
  const Shell shell;
  writeAll(shell.file("bands.json"), rgbOfBox);
  writeAll(shell.file("edits.json"), R"({"frames": [[{"emission": "light", "to": [3, 0, 0]}]]})");
  shell.output(quick + "-o out --bands bands.json --edits edits.json");
  const json energy = json::parse(readAll(shell.file("out/frame-1/solution.json")))["energy"];
  CHECK(energy["emitted"][0] == 0);
  CHECK(energy["emitted"][1] == 0);
  for (std::size_t band = 0; band < 3; ++band) {
    const auto flux = [&](const char* name) { return energy[name][band].get<double>(); };
    CHECK(flux("absorbed") + flux("unshot") + flux("lost") ==
          Approx(flux("emitted")).epsilon(1e-9).margin(1e-9 * energy["emitted"][2].get<double>()));
  }
}

TEST_CASE("hemitex solve --bands works with an error bound, adaptive elements, a report and a light map", "[cli]") {
  const std::string option = GENERATE(as<std::string>(), "--max-error 0.2", "--adaptive 0.002",
                                      "--adaptive 0.002 --max-error 0.2", "--report", "--lightmap");
  INFO(option);
  const std::string solve = "solve " + box + " --texels 8 --size 40x30 " + option;
  const Shell shell;
  writeAll(shell.file("bands.json"), rgbOfBox);
  shell.output(solve + " -o rgb");
  shell.output(solve + " -o bands --bands bands.json");
  const json rgb = solutionOf(shell, "rgb")["energy"], bands = solutionOf(shell, "bands")["energy"];
  for (std::size_t band = 0; band < 3; ++band) {
    const auto flux = [&](const char* name) { return bands[name][band].get<double>(); };
    CHECK(flux("absorbed") + flux("unshot") + flux("lost") == Approx(flux("emitted")).epsilon(1e-9));
    // The choice of elements sees other colours. Each of the two choices may be wrong by what it tolerates.
    CHECK(flux("absorbed") == Approx(rgb["absorbed"][2 - band].get<double>()).epsilon(0.02));
  }
  if (option.find("--adaptive") != std::string::npos) return;
  for (const auto& [band, channel] : {std::pair{"b_650", "b_r"}, std::pair{"b_550", "b_g"}, std::pair{"b_450", "b_b"}})
    CHECK(columnOf(shell, "bands", band) == columnOf(shell, "rgb", channel));
}

TEST_CASE("hemitex solve reads Kd spectral and Ke spectral, in bands and as colours", "[cli]") {
  const Shell shell;
  std::string mtl = readAll(shell.file("room.mtl"));
  writeAll(shell.file("flat.rfl"), "300 0.4\n900 0.4\n");
  writeAll(shell.file("bulb.rfl"), "400 1 # nm, W/m^2 per nm\n700 4\n");
  const std::string obj = readAll(shell.file("room.obj"));
  const std::size_t at = obj.find("usemtl ");
  REQUIRE(at != std::string::npos);
  const std::string name = obj.substr(at + 7, obj.find('\n', at) - at - 7);
  writeAll(shell.file("room.mtl"), "newmtl " + name + "\nKd spectral flat.rfl 0.5\nKe spectral bulb.rfl 2\n" + mtl);
  shell.output(quickSolve + "-o colour");
  const json colour = solutionOf(shell, "colour");
  bool isFound = false;
  for (const json& surface : colour["surfaces"]) {
    if (surface["emission"][0] == 0) continue;
    for (std::size_t channel = 0; channel < 3; ++channel)
      if (surface["reflectance"][channel].get<double>() == Approx(0.2).epsilon(1e-12)) isFound = true;
  }
  CHECK(isFound);
  writeAll(shell.file("bands.json"), R"({"wavelengths": [400, 550, 700]})");
  shell.output(quickSolve + "-o bands --bands bands.json");
  const json emitted = solutionOf(shell, "bands")["energy"]["emitted"];
  CHECK(emitted[2].get<double>() > 2 * emitted[0].get<double>());
  writeAll(shell.file("bulb.rfl"), "700 1\n400 1\n");
  const Outcome outcome = shell.run(quickSolve + "-o bad");
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Catch::Contains("bulb.rfl:2: the wavelength is not above the one before"));
}
