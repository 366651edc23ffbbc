/// Test cases of Catch2 for a backend in C++: one per vector of a suite. For Catch2 2.13 and 3.
///
///     const std::size_t tests = hemitex::reference::registerConformanceTests(
///         "my backend", [](const raster::DrawList& list) { return std::make_unique<MyBackend>(list); });
///
/// as a static variable of the test program, or as a statement of its `main` before the session. The program links
/// hemitex::conformance and Catch2.
#pragma once

#include <string>
#include <utility>
#include <vector>

// A program may have both versions of Catch2: the one that it has included counts.
#if !defined(TWOBLUECUBES_SINGLE_INCLUDE_CATCH_HPP_INCLUDED)
#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_test_macros.hpp>
#include <catch2/interfaces/catch_interfaces_registry_hub.hpp>
#else
#include <catch2/catch.hpp>
#endif
#endif

#include "reference/conformance/cases/conformance_case.h"

namespace hemitex::reference {

/// The macros inside are those that both versions share, with and without CATCH_CONFIG_PREFIX_ALL.
class ConformanceTest final : public Catch::ITestInvoker {
 public:
  ConformanceTest(ConformanceCase test, BackendFactory makeBackend, std::vector<NamedProfile> profiles)
      : test_(std::move(test)), makeBackend_(std::move(makeBackend)), profiles_(std::move(profiles)) {}

  void invoke() const override {
    for (const NamedProfile& profile : profiles_) {
      INTERNAL_CATCH_DYNAMIC_SECTION("profile " << profile.name) {
        const std::string failure = failureOf(test_.vector(), makeBackend_, profile.profile);
        const auto result = failure.empty() ? Catch::ResultWas::Ok : Catch::ResultWas::ExplicitFailure;
        INTERNAL_CATCH_MSG("conformance", result, Catch::ResultDisposition::ContinueOnFailure, failure);
      }
    }
  }

 private:
  ConformanceCase test_;
  BackendFactory makeBackend_;
  std::vector<NamedProfile> profiles_;
};

/// `[conformance]` and the family. A vector that is expected to fail, or flaky, may fail; one that is unsupported is
/// hidden, so that it is drawn only where its name or tag is given.
inline std::string tagsOf(const ConformanceCase& test) {
  const std::string tags = "[conformance][" + test.family + "]";
  if (!test.expected) return tags;
  return tags + (test.expected->expectation == Expectation::Unsupported ? "[.unsupported]" : "[!mayfail]");
}

/// Registers the test cases `BACKEND: VECTOR`, with a section per profile, and returns their number. A wrong setting is
/// an error at the start of the session.
inline std::size_t registerConformanceTests(const std::string& backend, const BackendFactory& makeBackend,
                                            const ConformanceSettings& settings = {}) {
  using Invoker = decltype(Catch::makeTestInvoker(std::declval<void (*)()>()));  // a pointer that Catch2 owns
  try {
    const std::vector<ConformanceCase> cases = conformanceCases(settings);
    const std::vector<NamedProfile> profiles = profilesOf(settings);
    for (const ConformanceCase& test : cases) {
      const std::string name = backend + ": " + test.name, tags = tagsOf(test);
      const Catch::AutoReg registered(Invoker(new ConformanceTest(test, makeBackend, profiles)),
                                      CATCH_INTERNAL_LINEINFO, Catch::StringRef(), Catch::NameAndTags{name, tags});
    }
    return cases.size();
  } catch (...) {
    Catch::getMutableRegistryHub().registerStartupException();
    return 0;
  }
}

}  // namespace hemitex::reference
