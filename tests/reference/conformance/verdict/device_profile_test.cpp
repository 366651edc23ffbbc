// Profiles and candidates on disk: valid ones are read, others refused.
#include "reference/conformance/verdict/device_profile.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "raster/base/input_error.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using raster::InputError;

TEST_CASE("readProfile keeps the default of each absent key", "[verdict]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "profile.json";
  std::ofstream(file) << R"({"subpixel_bits": 4, "snap_rounding": "truncate", "edge_rule": "any", "vertex_error": 2.5,
                            "depth_format": "unorm16", "loose_clipping": false, "strict_depth": true})";
  const reference::DeviceProfile profile = reference::readProfile(file);
  CHECK(profile.subpixelBits == 4);
  CHECK(profile.snapRounding == reference::SnapRounding::Truncate);
  CHECK(profile.edgeRule == reference::EdgeRule::Any);
  CHECK(profile.vertexError == 2.5);
  CHECK_FALSE(profile.looseClipping);
  CHECK(profile.texelPrecision == 1.0 / 256);
  CHECK(profile.depthTolerance == 4);
  CHECK(reference::depthError(profile) == 4.0 / 65535);
}

TEST_CASE("depthError is in units in the last place of 1 of the depth format", "[verdict]") {
  using reference::DepthFormat;
  for (const auto& [format, unit] :
       {std::pair(DepthFormat::Float32, 1 / 8388608.0), std::pair(DepthFormat::Unorm24, 1 / 16777215.0),
        std::pair(DepthFormat::Unorm16, 1 / 65535.0)}) {
    reference::DeviceProfile profile;
    profile.depthFormat = format;
    profile.depthTolerance = 3;
    CHECK(reference::depthError(profile) == Approx(3 * unit).epsilon(1e-12));
  }
}

TEST_CASE("readProfile reads back what toJson writes", "[verdict]") {
  using namespace reference;
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "profile.json";
  for (const DeviceProfile& profile : {DeviceProfile{},
                                       DeviceProfile{0.1, 16, SnapRounding::Truncate, EdgeRule::Any, 0x1.8p-13, 12.5,
                                                     DepthFormat::Unorm24, 2.5, false},
                                       DeviceProfile{.depthFormat = DepthFormat::Unorm16}}) {
    std::ofstream(file) << toJson(profile);
    CHECK(readProfile(file) == profile);
  }
}

TEST_CASE("readProfile reads version 1, which has no interpolation error, with its old meaning", "[verdict]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "profile.json";
  for (const char* json : {R"({"texel_precision": 0.125})", R"({"version": 1, "texel_precision": 0.125})"}) {
    std::ofstream(file) << json;
    CHECK(reference::readProfile(file) == reference::DeviceProfile{.texelPrecision = 0.125, .interpolationError = 0});
  }
  std::ofstream(file) << R"({"version": 2, "interpolation_error": 16})";
  CHECK(reference::readProfile(file) == reference::DeviceProfile{.interpolationError = 16});
}

TEST_CASE("texelError adds roundings of 2^-24 of the largest coordinate, scaled by the ratio of depths", "[verdict]") {
  const reference::DeviceProfile profile{.texelPrecision = 0.25, .interpolationError = 8};
  // u N = 1024 x 2, w = 30, and w = 3 at the nearest corner.
  CHECK(reference::texelError(profile, 1024, 2, 3, 1.0 / 30) == Approx(0.25 + 8 * 2048 * 10 / 16777216.0));
}

TEST_CASE("readProfile throws for an unknown key or a wrong value", "[verdict]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "profile.json";
  for (const char* json : {R"({"subpixel_bit": 8})",
                           R"({"subpixel_bits": 8.5})",
                           R"({"subpixel_bits": 3})",
                           R"({"subpixel_bits": 17})",
                           R"({"subpixel_bits": "8"})",
                           R"({"vertex_error": -1})",
                           R"({"vertex_error": 1e999})",
                           R"({"texel_precision": null})",
                           R"({"snap_rounding": "up"})",
                           R"({"edge_rule": 1})",
                           R"({"depth_format": "float"})",
                           R"({"loose_clipping": 1})",
                           R"({"strict_depth": null})",
                           R"({"version": 3})",
                           R"({"version": "2"})",
                           R"({"interpolation_error": 1})",
                           R"({"version": 2, "interpolation_error": -1})",
                           R"([])",
                           R"({)",
                           ""}) {
    std::ofstream(file) << json;
    INFO(json);
    CHECK_THROWS_AS(reference::readProfile(file), InputError);
  }
  CHECK_THROWS_AS(reference::readProfile(folder.path / "missing.json"), InputError);
  CHECK_THROWS_AS(reference::readProfile(folder.path), InputError);
}

TEST_CASE("readCandidate reads item buffers and refuses sizes other than one item ID per pixel", "[verdict]") {
  reference::TestVector vector;
  raster::Face face = tests::frontFace(4);
  face.scissor = {0, 2, 4, 2};
  vector.faces = {{"side", face, "side.u32", ""}};
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "side.u32";
  CHECK_THROWS_AS(reference::readCandidate(folder.path, vector), InputError);  // missing

  const auto write = [&](std::size_t bytes) {
    std::ofstream stream(file, std::ios::binary);
    for (std::size_t k = 0; k < bytes; ++k) stream.put(static_cast<char>(k));
  };
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{31}, std::size_t{33}, std::size_t{28}, std::size_t{64}}) {
    write(bytes);
    INFO(bytes << " bytes");
    CHECK_THROWS_AS(reference::readCandidate(folder.path, vector), InputError);
  }
  write(32);
  const std::vector<raster::ItemBuffer> buffers = reference::readCandidate(folder.path, vector);
  REQUIRE(buffers.size() == 1);
  CHECK(buffers[0].width == 4);
  CHECK(buffers[0].height == 2);
  CHECK(buffers[0].ids.size() == 8);
  CHECK(buffers[0].ids[1] == 0x07060504u);  // little-endian

  vector.faces.push_back({"other", face, "other.u32", ""});
  CHECK_THROWS_AS(reference::readCandidate(folder.path, vector), InputError);
  std::ofstream(folder.path / "other.u32", std::ios::binary) << std::string(32, '\1');
  CHECK(reference::readCandidate(folder.path, vector)[1].ids[0] == 0x01010101u);
  vector.faces.pop_back();

  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  CHECK_THROWS_AS(reference::readCandidate(folder.path, vector), InputError);
}
