#include "cli/scene/symmetry_options.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common/json.h"
#include "cli/common/numbers.h"

namespace hemitex::cli {
namespace {

constexpr std::string_view axisNames = "xyz";

void readMirror(const std::string& text, radiosity::Symmetry& symmetry) {
  const std::size_t axis = text.empty() ? std::string::npos : axisNames.find(text[0]);
  const std::optional<double> value =
      text.size() > 2 && text[1] == '=' ? parseNumber(std::string_view(text).substr(2)) : std::nullopt;
  if (axis == std::string::npos || !value) usageError("--mirror", "`" + text + "` is not x=N, y=N or z=N");
  symmetry.mirrors[axis].push_back(*value);
}

}  // namespace

void addSymmetryOptions(Command command, radiosity::Symmetry& symmetry) {
  command = command.under("Symmetry");
  command.addTexts("--mirror", "AXIS=N",
                   "the scene continues behind a mirror in the plane x=N, y=N or z=N; at most two planes across each "
                   "axis (repeatable)",
                   [&symmetry](const std::string& text) { readMirror(text, symmetry); });
  addVectorOption(command, "--periodic", symmetry.period,
                  "the scene is a box that is repeated with these lengths along x, y and z; 0 means not repeated");
  addInteger(command, "--repeats", symmetry.repeats, 1, 1000,
             "draw N images on each side of a box that --periodic or two mirror planes repeat; light that goes farther "
             "meets the surroundings (default 4)");
}

nlohmann::ordered_json toJson(const radiosity::Symmetry& symmetry) {
  return {{"mirrors", {{"x", symmetry.mirrors[0]}, {"y", symmetry.mirrors[1]}, {"z", symmetry.mirrors[2]}}},
          {"period", {symmetry.period.x, symmetry.period.y, symmetry.period.z}},
          {"repeats", orNull(symmetry.repeats)}};
}

}  // namespace hemitex::cli
