#include "radiosity/meshes/length_unit.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <set>
#include <utility>

#include "radiosity/base/text_lines.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

struct Length {
  std::string_view names;  ///< with a blank on each side
  double metres;
};

constexpr std::array lengths{Length{" m meter meters metre metres ", 1.0},
                             Length{" cm centimeter centimeters centimetre centimetres ", 0.01},
                             Length{" mm millimeter millimeters millimetre millimetres ", 0.001},
                             Length{" km kilometer kilometers kilometre kilometres ", 1000.0},
                             Length{" inch inches ", 0.0254},
                             Length{" ft foot feet ", 0.3048},
                             Length{" yd yard yards ", 0.9144}};

/// The names and numbers of a comment, in small letters.
std::vector<std::string> wordsOf(std::string_view comment) {
  std::vector<std::string> words(1);
  const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t i = 0; i < comment.size(); ++i) {
    const bool isPoint = comment[i] == '.' && i + 1 < comment.size() && isPart(comment[i + 1]);
    if (isPart(comment[i]) || isPoint)
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(comment[i])));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool isUnit(const std::string& word) { return word == "unit" || word == "units"; }

/// The lengths that a comment about units names, and 0 for a number that is not 1.
std::set<double> lengthsIn(std::string_view comment) {
  const std::vector<std::string> words = wordsOf(comment);
  std::set<double> found;
  if (std::none_of(words.begin(), words.end(), isUnit)) return found;
  for (const std::string& word : words) {
    for (const Length& length : lengths)
      if (length.names.find(" " + word + " ") != length.names.npos) found.insert(length.metres);
    if (const std::optional<double> number = numberOf(word); number && *number != 1) found.insert(0);
  }
  if (words.size() > 1 && words.back() == "in" && isUnit(words[words.size() - 2])) found.insert(0.0254);
  return found == std::set<double>{0} ? std::set<double>() : found;
}

}  // namespace

std::optional<double> statedMetresPerUnit(std::string_view text, std::vector<std::string>& warnings) {
  std::set<double> found;
  std::string_view comment;
  while (!text.empty() && !text.starts_with("v ")) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    if (text.starts_with('#')) {
      const std::set<double> some = lengthsIn(text.substr(0, end));
      if (!some.empty()) comment = text.substr(0, end);
      found.insert(some.begin(), some.end());
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (found.size() == 1) return *found.begin();
  if (found.size() > 1)
    warnings.push_back("the unit of lengths is not clear, and counts as a metre: `" + raster::excerpt(comment) + "`");
  return std::nullopt;
}

std::optional<double> statedMetresPerUnit(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  const raster::InputFile opened = raster::tryOpenFile(file);
  std::string head(std::size_t{1} << 16, '\0');
  head.resize(opened ? std::fread(head.data(), 1, head.size(), opened.get()) : 0);
  return statedMetresPerUnit(std::string_view(head), warnings);
}

}  // namespace hemitex::radiosity
