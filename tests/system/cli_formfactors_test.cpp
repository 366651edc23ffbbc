/// hemitex formfactors: rows and matrices by each method, and their checks.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "reference/base/hashes/sha256.h"
#include "reference/matrices/matrix_files.h"
#include "tests/support/shell.h"
#include "tests/truth/rectangles.h"

using namespace hemitex::tests;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("hemitex formfactors from a surface of a closed room sum to 1", "[cli]") {
  const Shell shell;
  // A share has 60 bits and a double 53, so that each of up to 96 numbers has a rounding error of at most half of
  // 2^-53.
  for (const char* from : {"floor", "floor:3,0", "'ceiling/lamp'", "'back:1,2'"}) {
    const auto lines =
        linesOf(shell.output("formfactors room.obj --texels 4 --resolution 32 --from " + std::string(from)));
    CHECK(lines.at(0) == "surface,column,row,area,form_factor");
    REQUIRE(lines.size() == 1 + 96);
    double sum = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) sum += lastNumber(lines[i]);
    CHECK(sum == Approx(1).margin(96 * 1.2e-16));
  }
}

TEST_CASE("hemitex formfactors --all prints the rows of its surfaces", "[cli]") {
  const Shell shell;
  const std::string settings = " --texels 4 --resolution 32 --by-surface";
  const auto matrix = linesOf(shell.output("formfactors room.obj --all" + settings));
  const auto row = linesOf(shell.output("formfactors room.obj --from left" + settings));
  CHECK(matrix.at(0) == "from,to,form_factor");
  CHECK(row.at(0) == "surface,area,form_factor");
  REQUIRE(matrix.size() == 1 + 36);
  REQUIRE(row.size() == 1 + 6);
  for (std::size_t to = 0; to < 6; ++to) CHECK(lastNumber(matrix[1 + 6 + to]) == lastNumber(row[1 + to]));
}

TEST_CASE("hemitex formfactors --method rays prints standard errors", "[cli]") {
  // The faces of a cube: 0.1998 to the opposite one (Howell C-11), and a quarter of the rest to each of the others.
  const Shell shell;
  for (const std::string settings : {"", " --aimed", " --texels 3"}) {
    const auto lines =
        linesOf(shell.output("formfactors room.obj --from floor --by-surface --method rays --samples 8192" + settings));
    REQUIRE(lines.size() == 1 + 6);
    CHECK(lines[0] == "surface,area,form_factor,standard_error");
    for (const std::string& line : lines) {
      if (line.starts_with("surface")) continue;
      const double error = lastNumber(line), value = lastNumber(line.substr(0, line.rfind(',')));
      const double exact = line.starts_with("floor") ? 0 : line.starts_with("ceiling") ? 0.199824896 : 0.200043776;
      INFO(settings << ": " << line);
      CHECK(std::abs(value - exact) <= 4 * error + 1e-9);
      CHECK(error < 0.01);
    }
  }
  const auto elements = linesOf(shell.output("formfactors room.obj --from floor:1,2 --texels 4 --method rays"));
  CHECK(elements.at(0) == "surface,column,row,area,form_factor,standard_error");
  CHECK(elements.size() == 1 + 96);
  const json row = json::parse(shell.output("formfactors room.obj --from floor --by-surface --method rays --json"));
  CHECK(row["samples"] == 65536);
  CHECK(row["row"][1]["standard_error"].get<double>() > 0);
}

TEST_CASE("hemitex formfactors --seed gives independent estimates, and 0 the default", "[cli]") {
  const Shell shell;
  const std::string rays = "formfactors room.obj --from floor --by-surface --method rays --samples 4096 --json";
  const json unseeded = json::parse(shell.output(rays)), first = json::parse(shell.output(rays + " --seed 0")),
             second = json::parse(shell.output(rays + " --seed 1"));
  CHECK(unseeded == first);
  CHECK(first["seed"] == 0);
  CHECK(second["seed"] == 1);
  int different = 0;
  for (std::size_t i = 0; i < first["row"].size(); ++i) {
    const double one = first["row"][i]["form_factor"], other = second["row"][i]["form_factor"],
                 error = std::hypot(first["row"][i]["standard_error"].get<double>(),
                                    second["row"][i]["standard_error"].get<double>());
    CHECK(std::abs(one - other) <= 4 * error);
    different += one != other;
  }
  CHECK(different >= 4);  // of five; two counts of rays may be equal by chance
}

TEST_CASE("hemitex formfactors --method analytic equals the closed forms, and reports that blockers are ignored",
          "[cli]") {
  // Faces of a cube: Howell C-11 and C-14 with all lengths equal, from the mean over the floor or over one of its
  // texels.
  const Shell shell;
  const Outcome outcome = shell.run("formfactors room.obj --from floor --by-surface --method analytic");
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.err.find("blockers are not looked at") != std::string::npos);
  const auto lines = linesOf(outcome.out);
  REQUIRE(lines.size() == 1 + 6);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const bool isFloor = lines[i].starts_with("floor"), isOpposite = lines[i].starts_with("ceiling");
    const double exact = isFloor ? 0 : isOpposite ? 0.199824895698387 : 0.200043776075403;
    INFO(lines[i]);
    CHECK(lastNumber(lines[i]) == Approx(exact).epsilon(1e-9));
  }
  const json row = json::parse(shell.output("formfactors room.obj --from floor --method analytic --texels 1 --json"));
  CHECK(row["blockers_ignored"] == true);
  for (const char* from : {"floor", "floor:1,2"}) {
    const auto elements =
        linesOf(shell.output("formfactors room.obj --texels 4 --method analytic --from " + std::string(from)));
    REQUIRE(elements.size() == 1 + 96);
    double sum = 0;
    for (std::size_t i = 1; i < elements.size(); ++i) sum += lastNumber(elements[i]);
    CHECK(sum == Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("hemitex formfactors of the paper's room: hemicubes and closed forms agree for unblocked surfaces", "[cli]") {
  // From the light, no ray to these surfaces meets the box; a part of the floor is behind it. A hemicube of 256 pixels
  // misses a few pixels along a surface's rim, each of up to 1/(pi 128^2) = 2e-5. The light shoots from 8 x 8 patches.
  const Shell shell;
  const std::string command =
      "formfactors " HEMITEX_DATA "/paper-room.obj --texels 16 --patch 2 --from light --by-surface --json --method ";
  const json analytic = json::parse(shell.output(command + "analytic"))["row"];
  const json hemicube = json::parse(shell.output(command + "hemicube"))["row"];
  REQUIRE(analytic.size() == 13);
  for (std::size_t i = 0; i < analytic.size(); ++i) {
    const auto name = analytic[i]["surface"].get<std::string>();
    const double excess = analytic[i]["form_factor"].get<double>() - hemicube[i]["form_factor"].get<double>();
    INFO(name << " " << excess);
    if (name == "floor") CHECK(excess > 0.05);
    for (const char* lit : {"wall-front", "wall-left", "ceiling", "box-top", "box-front", "box-left"})
      if (name == lit) CHECK(std::abs(excess) < 2e-4);
  }
}

TEST_CASE("hemitex formfactors and solve with other projections report the captured share", "[cli]") {
  // A cubic tetrahedron sees the same as a hemicube. The plane, of half-width 4, captures 4/pi c atan(c) of the light
  // with c = 4 / sqrt(17); in a closed room only the rest leaves.
  const Shell shell;
  const double c = 4 / std::sqrt(17.0), captured = 4 / M_PI * c * std::atan(c);
  const auto row = [&](const std::string& method) {
    return json::parse(shell.output("formfactors room.obj --from floor --by-surface --json --method " + method));
  };
  const json hemicube = row("hemicube"), tetrahedron = row("tetrahedron"), plane = row("single-plane");
  CHECK(hemicube["captured"] == 1);
  CHECK(tetrahedron["captured"] == 1);
  CHECK(tetrahedron["background"] == 0);
  CHECK(plane["captured"].get<double>() == Approx(captured).epsilon(1e-12));
  CHECK(plane["background"].get<double>() == Approx(1 - captured).epsilon(1e-12));
  for (std::size_t i = 0; i < hemicube["row"].size(); ++i)
    CHECK(tetrahedron["row"][i]["form_factor"].get<double>() ==
          Approx(hemicube["row"][i]["form_factor"].get<double>()).margin(1e-3));

  const Outcome lossy =
      shell.run("solve room.obj -o plane --size 40x30 --texels 4 --resolution 64 --method single-plane --json");
  REQUIRE(lossy.exitCode == 0);
  const json solution = json::parse(lossy.out);
  CHECK(solution["settings"]["method"] == "single-plane");
  CHECK(solution["captured"].get<double>() == Approx(captured).epsilon(1e-12));
  CHECK(solution["warnings"].size() == 1);
  CHECK(solution["energy"]["lost"][0].get<double>() > 0.04 * solution["energy"]["emitted"][0].get<double>());
  const json whole = json::parse(
      shell.output("solve room.obj -o all --size 40x30 --texels 4 --resolution 64 --method tetrahedron --json"));
  CHECK(whole["captured"] == 1);
  CHECK(whole["warnings"].empty());
  CHECK(whole["energy"]["lost"][0] == 0);
}

TEST_CASE("hemitex formfactors --pixels-per-element gives smoother rows", "[cli]") {
  // A ceiling of 32 x 32 elements in at most 16 x 16 pixels: at most one element in four is met, but all blocks are.
  const Shell shell;
  const auto seen = [&](const std::string& options) {
    const json result = json::parse(shell.output(
        "formfactors room.obj --from floor:16,16 --texels 32 --resolution 16 --split 1 --json " + options));
    double sum = result["background"].get<double>() + result["back"].get<double>();
    int met = 0;
    for (const json& element : result["row"]) {
      sum += element["form_factor"].get<double>();
      met += element["surface"] == "ceiling/lamp" && element["form_factor"].get<double>() > 0;
    }
    CHECK(sum == Approx(1).epsilon(1e-12));
    return std::pair(met, result["pixels_per_element"].get<double>());
  };
  const auto [few, none] = seen("");
  const auto [all, four] = seen("--pixels-per-element 4");
  CHECK(none == 0);
  CHECK(four == 4);
  CHECK((few > 0 && few <= 256));
  CHECK(all == 1024);
}

TEST_CASE("hemitex formfactors --output goes on after the rows of a run that was killed", "[cli]") {
  const Shell shell;
  const std::string matrix = "formfactors room.obj --all --by-surface --texels 32 --resolution 512 --threads 1 ";
  const std::string command = "'" HEMITEX_PROGRAM "' " + matrix + "-o m.csv";
  const Outcome second = shell.execute(
      command + " & run=$!\nwhile kill -0 $run && ! [ \"$(wc -l <m.csv.part)\" -ge 3 ]\ndo sleep 0.01\ndone " +
      "2>/dev/null\n" + command + "\ncode=$?\nkill -KILL $run\nwait $run\nexit $code");
  CHECK(second.exitCode == 2);
  CHECK_THAT(second.err, Contains("m.csv: is in use"));
  CHECK_FALSE(shell.files().contains("m.csv"));
  const Outcome last = shell.run(matrix + "-o m.csv");
  CHECK(last.exitCode == 0);
  CHECK_THAT(last.err, Contains("goes on after"));
  auto files = shell.files();
  CHECK(files.at("m.csv") == shell.output(matrix));
  CHECK(files.size() == Shell().files().size() + 1);
}

TEST_CASE("hemitex formfactors --output does not replace the scene", "[cli]") {
  const Shell shell;
  const auto before = shell.files();
  const Outcome outcome = shell.run("formfactors room.obj --all --by-surface --texels 4 -o ./room.obj");
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Contains("room.obj: is read by this run"));
  CHECK(shell.files() == before);
}

TEST_CASE("hemitex formfactors --all reports the checks of matrices", "[cli]") {
  // In a closed cube rows sum to 1. The errors of rays, about 1e-3 each, and those of hemicubes break reciprocity.
  const Shell shell;
  for (const std::string method : {"rays", "hemicube"}) {
    const std::string command = "formfactors room.obj --all --by-surface --json --method " + method;
    const Outcome outcome = shell.run(command);
    REQUIRE(outcome.exitCode == 0);
    const json result = json::parse(outcome.out);
    CHECK(result["matrix"].size() == 36);
    CHECK(result["matrix"][1].contains("standard_error") == (method == "rays"));
    CHECK(result["row_sums"][0].get<double>() == Approx(1).epsilon(1e-12));
    CHECK(result["row_sums"][1].get<double>() == Approx(1).epsilon(1e-12));
    CHECK(result["reciprocity"].get<double>() < 0.01);
    CHECK(outcome.err.find("rows sum to ") != std::string::npos);
    CHECK(outcome.err.find("at most 0 (from ") != std::string::npos);
    CHECK(outcome.err.find("reciprocity is missed by at most ") != std::string::npos);
    CHECK(shell.run(command + " -q").err.empty());

    const Outcome smooth = shell.run(command + " --smooth");
    CHECK(smooth.err.find("smoothing moved form factors by at most ") != std::string::npos);
    const json smoothed = json::parse(smooth.out);
    CHECK(smoothed["reciprocity"].get<double>() < 1e-12);
    CHECK(smoothed["row_sums"][0].get<double>() == Approx(1).epsilon(1e-12));
    double largest = 0;
    for (std::size_t i = 0; i < 36; ++i)
      largest = std::max(largest, std::abs(smoothed["matrix"][i]["form_factor"].get<double>() -
                                           result["matrix"][i]["form_factor"].get<double>()));
    CHECK(smoothed["smoothing"]["largest"].get<double>() == largest);
    CHECK((largest > 1e-6 && largest < 0.01));
  }
}

TEST_CASE("hemitex formfactors -o keeps a file of others whose name is that of its unfinished rows", "[cli]") {
  const Shell shell;
  for (const std::string text : {"my notes", "my notes\n"}) {
    writeAll(shell.file("m.csv.part"), text);
    const Outcome outcome = shell.run("formfactors room.obj --all --by-surface --resolution 32 -o m.csv");
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains("m.csv.part:1: the rows belong to another scene or other settings"));
    CHECK(readAll(shell.file("m.csv.part")) == text);
    CHECK(shell.files().size() == Shell().files().size() + 1);  // no lock, no temporary folder
  }
  shell.execute("rm m.csv.part");
  CHECK(shell.run("formfactors room.obj --all --by-surface --resolution 32 -o m.csv").exitCode == 0);
}

TEST_CASE("hemitex formfactors --json -o prints the checks of the matrix that it writes", "[cli]") {
  const Shell shell;
  const json told =
      json::parse(shell.run("formfactors room.obj --all --by-surface --resolution 32 --json -q -o m.json").out);
  const json written = json::parse(readAll(shell.file("m.json")));
  CHECK(written["matrix"].size() == 36);
  for (const char* key : {"row_sums", "reciprocity"}) CHECK(told[key] == written[key]);
}

TEST_CASE("hemitex formfactors --all -o F.npz, .mtx and .csv writes the same sparse matrix, and what it means",
          "[cli]") {
  namespace reference = hemitex::reference;
  const Shell shell;
  // Of the six faces of the room, the lamp is a part of the ceiling.
  shell.output("formfactors room.obj --all --facets --texels 3 --resolution 64 -o F.npz");
  const reference::MatrixFile read = reference::readMatrix(shell.file("F.npz"));
  const std::size_t facets = read.matrix.rows();
  CHECK(read.matrix.columns == facets + 2);
  CHECK(read.matrix.value.size() < facets * (facets + 2));
  for (std::size_t r = 0; r < facets; ++r) {
    double sum = 0;
    for (const double factor : read.matrix.row(r).value) sum += factor;
    CHECK(sum == Approx(1).epsilon(1e-12));
  }
  const json about = json::parse(readAll(shell.file("F.json")));
  CHECK(about["facets"] == facets);
  CHECK(about["column_surroundings"] == facets);
  CHECK(about["column_backs"] == facets + 1);
  CHECK(about["sha256"] == reference::sha256OfFile(shell.file("F.npz")));
  CHECK(about["area"].get<std::vector<double>>() == read.area);
  CHECK(about["entries"] == read.matrix.value.size());
  for (const char* name : {"G.mtx", "G.csv"}) {
    shell.output("formfactors room.obj --all --facets --texels 3 --resolution 64 -o " + std::string(name));
    reference::SparseMatrix matrix = reference::readMatrix(shell.file(name)).matrix;
    // Nothing leaves the room, so that no line of the CSV names the last two columns.
    if (std::string(name) == "G.csv") CHECK(std::exchange(matrix.columns, facets + 2) == facets);
    CHECK(matrix == read.matrix);
  }
  CHECK(shell.files().size() == Shell().files().size() + 6);  // each matrix has its JSON file
}

TEST_CASE("hemitex formfactors --facets gives the row of each face of a mesh, and --by-surface the sums", "[cli]") {
  // Two unit squares face each other at distance 1: 0.1998 from one to the other (Howell C-11). Two triangles are one
  // square; a face without area keeps its number.
  const Shell shell;
  writeAll(shell.file("m.ply"),
           "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n"
           "1 0 1\n1 1 1\n0 1 1\n4 0 1 2 3\n3 0 1 1\n3 4 7 6\n3 4 6 5\n");
  shell.output("formfactors m.ply --all --texels 8 --patch 1 -o F.npz");
  const hemitex::reference::MatrixFile read = hemitex::reference::readMatrix(shell.file("F.npz"));
  REQUIRE(read.matrix.rows() == 4);
  CHECK(read.area == std::vector<double>{1, 0, 0.5, 0.5});
  CHECK(read.matrix.row(1).value.empty());
  const auto row = read.matrix.row(0);
  REQUIRE(std::vector(row.column.begin(), row.column.end()) == std::vector<std::uint32_t>{2, 3, 4});
  CHECK(row.value[0] + row.value[1] == Approx(0.199824896).margin(1e-3));
  CHECK(row.value[0] == Approx(row.value[1]).margin(1e-3));
  shell.output("formfactors m.ply --all --texels 8 --patch 1 --smooth -o S.npz");
  CHECK(json::parse(readAll(shell.file("S.json")))["smoothing"]["root_mean_square"].is_number());
  const auto lines = linesOf(shell.output("formfactors m.ply --all --by-surface"));
  CHECK(lines.size() == 2);
  // Also estimated errors have one number per face.
  for (const std::string smooth : {"", " --smooth"}) {
    shell.output("formfactors m.ply --all --max-error 0.1 -o E.npz" + smooth);
    const auto errors = json::parse(readAll(shell.file("E.json")))["errors"].get<std::vector<double>>();
    REQUIRE(errors.size() == 4);
    CHECK(errors[1] == 0);
    CHECK(errors[3] > 0);
  }
}

namespace {

/// A quarter of a room of side 2 with a block in its middle, and its images behind x = 0, z = 0 and both, as one OBJ.
/// With `images` = 1 the quarter alone. The planes of the mirrors have no faces.
std::string quarteredRoom(int images) {
  using Corner = std::array<double, 3>;
  const std::vector<std::array<Corner, 4>> quads{
      {{{0, -1, 0}, {0, -1, 1}, {1, -1, 1}, {1, -1, 0}}},            // floor
      {{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}},                // ceiling
      {{{1, -1, 0}, {1, -1, 1}, {1, 1, 1}, {1, 1, 0}}},              // wall x = 1
      {{{0, -1, 1}, {0, 1, 1}, {1, 1, 1}, {1, -1, 1}}},              // wall z = 1
      {{{0, .25, 0}, {0, .25, .5}, {.5, .25, .5}, {.5, .25, 0}}},    // top of the block
      {{{0, -.5, 0}, {.5, -.5, 0}, {.5, -.5, .5}, {0, -.5, .5}}},    // its bottom
      {{{.5, -.5, 0}, {.5, .25, 0}, {.5, .25, .5}, {.5, -.5, .5}}},  // its sides
      {{{0, -.5, .5}, {.5, -.5, .5}, {.5, .25, .5}, {0, .25, .5}}}};
  std::string text;
  for (int image = 0; image < images; ++image) {
    const double x = image % 2 == 1 ? -1 : 1, z = image >= 2 ? -1 : 1;
    for (const auto& quad : quads) {
      for (const Corner& corner : quad)
        text += "v " + std::to_string(x * corner[0]) + ' ' + std::to_string(corner[1]) + ' ' +
                std::to_string(z * corner[2]) + '\n';
      text += x * z > 0 ? "f -4 -3 -2 -1\n" : "f -1 -2 -3 -4\n";
    }
  }
  return text;
}

}  // namespace

TEST_CASE("hemitex formfactors --mirror gives the rows of the whole scene from a quarter of it", "[cli]") {
  namespace reference = hemitex::reference;
  const Shell shell;
  writeAll(shell.file("whole.obj"), quarteredRoom(4));
  writeAll(shell.file("quarter.obj"), quarteredRoom(1));
  constexpr std::uint32_t facets = 8;
  for (const std::string settings : {"--resolution 64 --texels 1 --split 1", "--resolution 64 --texels 2 --split 1",
                                     "--resolution 64 --texels 2", "--max-error 0.1", "--max-error 0.1 --smooth"}) {
    CAPTURE(settings);
    shell.output("formfactors whole.obj --all --facets " + settings + " -o W.npz");
    shell.output("formfactors quarter.obj --all --facets --mirror x=0 --mirror z=0 " + settings + " -o Q.npz");
    const reference::SparseMatrix whole = reference::readMatrix(shell.file("W.npz")).matrix;
    const reference::SparseMatrix quarter = reference::readMatrix(shell.file("Q.npz")).matrix;
    REQUIRE(quarter.rows() == facets);
    REQUIRE(quarter.columns == facets + 2);
    // The images come in the same order. Each facet is drawn from the same points, so that rows are equal up to the
    // order of sums. But patches are divided by the light that returns to them, and small receivers near them are
    // corrected; in the quarter by all images of an element together, so that it has more parts. And a smoothed row of
    // the whole room depends on those of its images.
    const bool isDivided = settings.ends_with("--texels 2"), isSmooth = settings.ends_with("--smooth");
    const double tolerance = isSmooth ? 5e-3 : isDivided ? 2e-3 : 1e-14;
    for (std::size_t r = 0; r < facets; ++r) {
      std::vector<double> sums(facets + 2), found(facets + 2);
      const reference::SparseRow all = whole.row(r), own = quarter.row(r);
      for (std::size_t k = 0; k < all.column.size(); ++k)
        sums[all.column[k] < 4 * facets ? all.column[k] % facets : all.column[k] - 3 * facets] += all.value[k];
      for (std::size_t k = 0; k < own.column.size(); ++k) found[own.column[k]] = own.value[k];
      for (std::size_t c = 0; c < facets + 2; ++c) CHECK(found[c] == Approx(sums[c]).margin(tolerance));
    }
  }
  const std::string check = "matrix check Q.npz quarter.obj --samples 65536 ";
  CHECK_THAT(shell.output(check + "--mirror x=0 --mirror z=0"), Contains("nothing wrong was found"));
  CHECK(shell.run(check).exitCode == 1);
  const json about = json::parse(readAll(shell.file("Q.json")));
  CHECK(about["settings"]["symmetry"]["mirrors"]["x"] == json{0});
}

TEST_CASE("hemitex formfactors --periodic sums over the boxes of a lattice", "[cli]") {
  // The floor of a box of side 1 and its ceiling, as wide as the box. With 3 repeats the floor sees a ceiling of 7 x 7.
  const Shell shell;
  const std::string floor = "o floor\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\no ceiling\n";
  writeAll(shell.file("box.obj"), floor + "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 8 7 6 5\n");
  writeAll(shell.file("wide.obj"), floor + "v -3 -3 1\nv 4 -3 1\nv 4 4 1\nv -3 4 1\nf 8 7 6 5\n");
  const auto last = [&](const std::string& command) {
    return lastNumber(linesOf(shell.output("formfactors " + command)).back());
  };
  const double wide = last("wide.obj --from floor --by-surface --method analytic");
  CHECK(last("box.obj --periodic 1,1,0 --repeats 3 --from floor --by-surface --method analytic") ==
        Approx(wide).epsilon(1e-9));
  CHECK(last("box.obj --periodic 1,1,0 --repeats 3 --from floor --by-surface --resolution 256") ==
        Approx(wide).margin(2e-3));
}

TEST_CASE("hemitex formfactors goes on with the rows of a sparse matrix that a killed run left", "[cli]") {
  const Shell shell;
  const std::string matrix = "formfactors room.obj --all --facets --texels 32 --resolution 512 --threads 1 -o F.npz";
  shell.execute("'" HEMITEX_PROGRAM "' " + matrix +
                " & run=$!\nwhile kill -0 $run && ! [ \"$(wc -l <F.npz.part)\" -ge 3 ]\ndo sleep 0.01\ndone " +
                "2>/dev/null\nkill -KILL $run\nwait $run");
  CHECK_FALSE(shell.files().contains("F.npz"));
  const Outcome last = shell.run(matrix);
  CHECK(last.exitCode == 0);
  CHECK_THAT(last.err, Contains("goes on after"));
  const auto files = shell.files();
  shell.output(matrix);
  CHECK(shell.files() == files);
  CHECK(files.size() == Shell().files().size() + 2);
}

TEST_CASE("hemitex formfactors refuses what no sparse matrix can be made of", "[cli]") {
  const Shell shell;
  for (const auto& [arguments, message] :
       {std::pair("--all", "needs --by-surface, or -o with a file that ends in .npz, .mtx or .csv"),
        {"--all -o F.txt", "does not end in .npz, .mtx or .csv"},
        {"--all --by-surface -o F.npz", "would be a table of text"},
        {"--all --by-surface -o F.mtx", "would be a table of text"},
        {"--all -o F.npz --method analytic", "rows sum to 1"},
        {"--all -o F.npz --method rays --aimed", "rows sum to 1"}}) {
    INFO(arguments);
    const Outcome outcome = shell.run("formfactors room.obj " + std::string(arguments));
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains(message));
  }
}

TEST_CASE("hemitex formfactors warns of rows of which backs take more than 1 %", "[cli]") {
  const Shell shell;
  const std::string floor =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ng floor\nf 1 2 3 4\n";
  writeAll(shell.file("right.obj"), floor + "g ceiling\nf 8 7 6 5\n");
  writeAll(shell.file("turned.obj"), floor + "g ceiling\nf 5 6 7 8\n");
  for (const std::string command : {"--from floor --by-surface", "--all --by-surface", "--all -o m.csv"}) {
    INFO(command);
    for (const std::string scene : {"right.obj", "turned.obj --flip ceiling"})
      CHECK_THAT(shell.run("formfactors " + scene + " " + command).err, !Contains("backs of faces take"));
    CHECK_THAT(shell.run("formfactors turned.obj " + command).err,
               Contains("backs of faces take more than 1 % of a row, most of the row of floor: 19.9"));
  }
}

TEST_CASE("hemitex formfactors --at gives the rows of points and their sky view factors", "[cli]") {
  const Shell shell;
  writeAll(shell.file("awning.obj"), "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\ng awning\nf 4 3 2 1\n");
  const double above = hemitex::tests::elementToParallelRectangle({{-1, 1}, {-1, 1}}, 1);
  const std::string options = "formfactors awning.obj --one-sided --resolution 512 ";
  const json row = json::parse(shell.output(options + "--at 0,0,0,0,0,2 --by-surface --json"));
  CHECK(row["from"] == "0,0,0,0,0,2");
  CHECK(row["row"][0]["form_factor"].get<double>() == Approx(above).epsilon(1e-3));
  CHECK(row["background"].get<double>() == Approx(1 - above).epsilon(1e-3));
  CHECK(row["back"] == 0.0);
  CHECK(shell.run(options + "--at 0,0,0,0,0,1").err.find("leaves the scene is 0.4459") != std::string::npos);

  // On the sheet itself, turned away from it, and from points of a file.
  writeAll(shell.file("points.csv"), "x,y,z,nx,ny,nz\r\n0,0,1,0,0,1\r\n0,0,0.999,0,0,1\r\n\n0,0,0,0,0,-1\n");
  const json rows = json::parse(shell.output(options + "--at points.csv --at 0,0,2,0,0,-1 --texels 2 --json"));
  CHECK(rows["row"].size() == 4 * 4);
  CHECK(rows["row"][5]["source"] == 2);
  CHECK(rows["background"][0] == 1.0);
  CHECK(rows["background"][1].get<double>() < 1e-4);
  CHECK(rows["background"][2] == 1.0);
  CHECK(rows["back"][3].get<double>() == Approx(above).epsilon(1e-3));
  const auto lines = linesOf(shell.output(options + "--at points.csv --texels 1"));
  CHECK(lines.at(0) == "source,surface,column,row,area,form_factor");
  CHECK(lines.size() == 1 + 3);

  // The row of a surface comes before those of points.
  const json surface = json::parse(shell.output(options + "--from awning --by-surface --json")),
             both = json::parse(shell.output(options + "--at 0,0,0,0,0,2 --from awning --by-surface --json"));
  CHECK(both["from"] == json({"awning", "0,0,0,0,0,2"}));
  CHECK(both["background"] == json({surface["background"], row["background"]}));
  CHECK(both["row"][1]["form_factor"] == row["row"][0]["form_factor"]);
}

TEST_CASE("hemitex formfactors refuses points that are none with exit code 2", "[cli]") {
  const Shell shell;
  writeAll(shell.file("faulty.csv"), "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n0,0,0,0,0\n");
  writeAll(shell.file("empty.csv"), "x,y,z,nx,ny,nz\n");
  writeAll(shell.file("short.csv"), "0,0,0,0,0\n0,0,0,0,0,1\n");
  const auto [options, message] = GENERATE(table<std::string, std::string>({
      {"--at 0,0,0,0,0,0", "no point and no file"},
      {"--at 0,0,0", "no point and no file"},
      {"--at missing.csv", "`missing.csv` is no point and no file"},
      {"--at faulty.csv", "faulty.csv:3: `0,0,0,0,0` is no point"},
      {"--at empty.csv", "has no point"},
      {"--at short.csv", "short.csv:1: `0,0,0,0,0` is no point"},
      {"--at 0,0,0,0,0,1 --all --by-surface", "--all"},
      {"--at 0,0,0,0,0,1 --method rays", "needs a --method that draws"},
  }));
  const Outcome outcome = shell.run("formfactors room.obj " + options);
  INFO(options << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find(message) != std::string::npos);
}
