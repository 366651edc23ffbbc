// The suite as test cases. tests/builds/catch2_suite runs them in a project outside.
#include "reference/conformance/cases/conformance_case.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/plain/plain_renderer.h"
#include "reference/conformance/cases/catch2_tests.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using reference::ConformanceCase;

namespace {

std::unique_ptr<raster::ItemBufferRenderer> plain(const raster::DrawList& list) {
  return std::make_unique<raster::PlainRenderer>(list);
}

/// The plain renderer, whose item buffers `change` makes wrong.
struct Wrong final : raster::ItemBufferRenderer {
  using Change = std::function<void(std::vector<raster::ItemBuffer>&)>;
  Wrong(const raster::DrawList& list, Change apply) : right(list), change(std::move(apply)) {}
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    right.draw(faces, skipped, buffers, drawn);
    change(buffers);
  }
  raster::PlainRenderer right;
  Change change;
};

std::string failureOfWrong(const reference::TestVector& vector, const Wrong::Change& change) {
  return failureOf(vector, [&](const raster::DrawList& list) { return std::make_unique<Wrong>(list, change); }, {});
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

reference::TestVector vectorNamed(const std::string& name) {
  for (const ConformanceCase& test : reference::conformanceCases({}))
    if (test.name == name) return test.vector();
  throw std::out_of_range(name);
}

}  // namespace

TEST_CASE("conformanceCases has a case per vector of the suite, with its theme", "[cases]") {
  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  const std::vector<ConformanceCase> cases = reference::conformanceCases({});
  REQUIRE(cases.size() == suite.size());
  std::map<std::string, std::string> families;
  for (std::size_t k = 0; k < suite.size(); ++k) {
    CHECK(cases[k].name == suite[k].name);
    CHECK(cases[k].vector().list.positions == suite[k].list.positions);
    families[cases[k].name] = cases[k].family;
  }
  CHECK(families["five-faces"] == "views");
  CHECK(families["equal-depths"] == "depth");
  CHECK(families["perspective-floor"] == "texels");
}

TEST_CASE("conformanceCases reads the vectors of a folder when they are drawn", "[cases]") {
  const TemporaryFolder folder;
  const reference::TestVector random = reference::randomVector(7, "slivers");
  for (const auto& [name, vector] : {std::pair("slivers-7", random), std::pair("mine-7", random),
                                     std::pair("five-faces", vectorNamed("five-faces"))}) {
    std::filesystem::create_directory(folder.path / name);
    reference::writeVector(folder.path / name, vector, {});
  }
  raster::writeFile(folder.path / "known.txt", "mine-7 flaky depends on threads\n");
  const auto cases = reference::conformanceCases({.suite = folder.path, .expectations = folder.path / "known.txt"});
  REQUIRE(cases.size() == 3);
  std::vector<std::string> names, tags;
  for (const ConformanceCase& test : cases) {
    names.push_back(test.name);
    tags.push_back(tagsOf(test));
  }
  CHECK(names == std::vector<std::string>{"five-faces", "mine-7", "slivers-7"});
  CHECK(tags ==
        std::vector<std::string>{"[conformance][views]", "[conformance][other][!mayfail]", "[conformance][slivers]"});
  CHECK(cases[2].vector().list.positions == random.list.positions);
  std::filesystem::remove_all(folder.path / "slivers-7");
  CHECK_THROWS_AS(cases[2].vector(), raster::InputError);
  raster::writeFile(folder.path / "known.txt", "yours-7 fail no such vector\n");
  CHECK_THROWS_AS(reference::conformanceCases({.suite = folder.path, .expectations = folder.path / "known.txt"}),
                  raster::InputError);
}

TEST_CASE("tagsOf hides unsupported vectors, and others with expectations may fail", "[cases]") {
  using reference::Expectation;
  const auto tags = [](Expectation expectation) {
    return tagsOf(ConformanceCase{"a", "ids", reference::ExpectedResult{"a", expectation, "b"}, {}});
  };
  CHECK(tags(Expectation::Fail) == "[conformance][ids][!mayfail]");
  CHECK(tags(Expectation::Unsupported) == "[conformance][ids][.unsupported]");
}

TEST_CASE("profilesOf names profiles after their files", "[cases]") {
  const TemporaryFolder folder;
  raster::writeFile(folder.path / "coarse.json", "{\"subpixel_bits\": 4}");
  const auto profiles = reference::profilesOf({.profiles = {{}, folder.path / "coarse.json"}});
  REQUIRE(profiles.size() == 2);
  CHECK(profiles[0].name == "default");
  CHECK(profiles[0].profile == reference::DeviceProfile{});
  CHECK(profiles[1].name == "coarse");
  CHECK(profiles[1].profile.subpixelBits == 4);
  CHECK_THROWS_AS(reference::profilesOf({.profiles = {folder.path / "absent.json"}}), raster::InputError);
}

TEST_CASE("failureOf is empty for the plain renderer, and derives a pixel of a wrong one", "[cases]") {
  const reference::TestVector vector = vectorNamed("perspective-floor");
  CHECK(failureOf(vector, plain, {}).empty());

  // Item IDs one too large.
  const std::string shifted = failureOfWrong(vector, [&](std::vector<raster::ItemBuffer>& buffers) {
    for (raster::ItemId& id : buffers[0].ids) id += id != raster::backgroundId(vector.list.format);
  });
  CHECK(contains(shifted, " pixels of perspective-floor are errors\n"));
  CHECK(contains(shifted, "\nthe vector finds: " + vector.catches + '\n'));
  CHECK(contains(shifted, "\nerror in front: pixel "));
  CHECK(contains(shifted, "\nedges (opposite the corners; inside > 0, and = 0 on top and left edges):\n"));
  CHECK(contains(shifted, "\nrunner_up (the next triangle; difference of 1/w): "));

  const std::string reversed = failureOfWrong(vector, [](std::vector<raster::ItemBuffer>& buffers) {
    std::reverse(buffers[0].ids.begin(), buffers[0].ids.end());
    for (int row = 0; row < buffers[0].height; ++row) {
      const auto first = buffers[0].ids.begin() + row * buffers[0].width;
      std::reverse(first, first + buffers[0].width);
    }
  });
  CHECK(contains(reversed, "\ndiagnosis: "));
  CHECK(contains(reversed, "picture upside down ("));
}

TEST_CASE("failureOf reports item buffers of the wrong number and size", "[cases]") {
  const reference::TestVector vector = vectorNamed("five-faces");
  CHECK(failureOfWrong(vector, [](auto& buffers) { buffers.pop_back(); }) ==
        "the backend returns 4 item buffers for 5 faces");
  const raster::Scissor& scissor = vector.faces[0].face.scissor;
  CHECK(failureOfWrong(vector, [](auto& buffers) { buffers[0].ids.pop_back(); }) ==
        "the item buffer of top has not " + std::to_string(scissor.width) + " x " + std::to_string(scissor.height) +
            " item IDs");
}
