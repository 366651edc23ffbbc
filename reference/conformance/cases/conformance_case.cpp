#include "reference/conformance/cases/conformance_case.h"

#include <algorithm>
#include <map>

#include "reference/conformance/diagnosis/failure_text.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"

namespace hemitex::reference {
namespace {

std::vector<ConformanceCase> casesOfSuite() {
  std::vector<ConformanceCase> cases;
  for (const SuiteTheme& theme : suiteThemes)
    for (const TestVector& vector : theme.vectors())
      cases.push_back({vector.name, theme.name, {}, [vector] { return vector; }});
  return cases;
}

/// Random vectors are named FAMILY-SEED.
std::string randomFamilyOf(const std::string& vector) {
  const std::string family = vector.substr(0, vector.rfind('-'));
  const bool isRandom = std::ranges::any_of(randomFamilies(), [&](const RandomFamily& f) { return family == f.name; });
  return isRandom ? family : "other";
}

std::vector<ConformanceCase> casesOfFolder(const std::filesystem::path& folder) {
  std::map<std::string, std::string> families;
  for (const ConformanceCase& test : casesOfSuite()) families.emplace(test.name, test.family);
  std::vector<ConformanceCase> cases;
  for (const std::filesystem::path& vector : vectorFolders(folder)) {
    const std::string name = (vector / "").parent_path().filename();  // also with a slash at the end
    const auto family = families.find(name);
    cases.push_back({name, family == families.end() ? randomFamilyOf(name) : family->second, {}, [vector] {
                       return readVector(vector);
                     }});
  }
  return cases;
}

/// What is wrong with the number and the sizes of item buffers; empty if they fit the faces.
std::string wrongSize(const TestVector& vector, const std::vector<raster::ItemBuffer>& found) {
  const auto text = [](std::size_t width, std::size_t height) {
    return std::to_string(width) + " x " + std::to_string(height);
  };
  if (found.size() != vector.faces.size())
    return "the backend returns " + std::to_string(found.size()) + " item buffers for " +
           std::to_string(vector.faces.size()) + " faces";
  for (std::size_t f = 0; f < found.size(); ++f) {
    const raster::Scissor& scissor = vector.faces[f].face.scissor;
    const auto width = static_cast<std::size_t>(scissor.width), height = static_cast<std::size_t>(scissor.height);
    if (found[f].width != scissor.width || found[f].height != scissor.height || found[f].ids.size() != width * height)
      return "the item buffer of " + vector.faces[f].name + " has not " + text(width, height) + " item IDs";
  }
  return {};
}

}  // namespace

std::vector<ConformanceCase> conformanceCases(const ConformanceSettings& settings) {
  std::vector<ConformanceCase> cases = settings.suite.empty() ? casesOfSuite() : casesOfFolder(settings.suite);
  if (settings.expectations.empty()) return cases;
  std::vector<std::string> names;
  for (const ConformanceCase& test : cases) names.push_back(test.name);
  for (const auto& [name, expected] : readExpectations(settings.expectations, names))
    std::ranges::find(cases, name, &ConformanceCase::name)->expected = expected;
  return cases;
}

std::vector<NamedProfile> profilesOf(const ConformanceSettings& settings) {
  std::vector<NamedProfile> profiles;
  for (const std::filesystem::path& file : settings.profiles)
    profiles.push_back(file.empty() ? NamedProfile{"default", {}} : NamedProfile{file.stem(), readProfile(file)});
  return profiles;
}

std::string failureOf(const TestVector& vector, const BackendFactory& makeBackend, const DeviceProfile& profile) {
  const std::vector<raster::ItemBuffer> found = raster::render(*makeBackend(vector.list), facesOf(vector));
  if (const std::string wrong = wrongSize(vector, found); !wrong.empty()) return wrong;
  const Report report = reportOn(vector, found, profile);
  return hasErrors(report.verdict) ? failureText(vector, report) : std::string();
}

}  // namespace hemitex::reference
