/// The vectors of a suite as test cases for a backend in C++, one case per vector. Needs no test framework;
/// catch2_tests.h makes tests of Catch2 of them.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "raster/interface/item_buffer_renderer.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/device_profile.h"
#include "reference/conformance/verdict/expectations.h"

namespace hemitex::reference {

/// Makes a backend for a draw list, which lives longer.
using BackendFactory = std::function<std::unique_ptr<raster::ItemBufferRenderer>(const raster::DrawList&)>;

struct ConformanceSettings {
  std::filesystem::path suite = {};                    ///< folder of vectors; empty: vectorSuite()
  std::filesystem::path expectations = {};             ///< file (expectations.h); empty: all vectors pass
  std::vector<std::filesystem::path> profiles = {{}};  ///< files; an empty path is the default profile
};

struct ConformanceCase {
  std::string name;    ///< of the vector
  std::string family;  ///< theme of vectorSuite() or family of random vectors; `other` for any other vector
  std::optional<ExpectedResult> expected;
  std::function<TestVector()> vector;  ///< reads the vector or copies it
};

/// One case per vector: those of a folder in the order of their names. Throws InputError for wrong expectations.
std::vector<ConformanceCase> conformanceCases(const ConformanceSettings& settings);

struct NamedProfile {
  std::string name;  ///< that of the file without its extension; `default`
  DeviceProfile profile;
};

/// Throws InputError for a file that is no profile.
std::vector<NamedProfile> profilesOf(const ConformanceSettings& settings);

/// What is wrong with the item IDs that a backend draws: how many pixels are errors, the diagnosis, the first errors,
/// and the derivation of one of them. Empty if no pixel is an error.
std::string failureOf(const TestVector& vector, const BackendFactory& makeBackend, const DeviceProfile& profile);

}  // namespace hemitex::reference
