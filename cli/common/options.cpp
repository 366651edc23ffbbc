#include "cli/common/options.h"

#include <bit>
#include <limits>
#include <optional>

#include "radiosity/ranks/messenger.h"

namespace hemitex::cli {

bool Context::isWriter() const { return !ranks || ranks->rank() == 0; }

std::set<std::filesystem::path> Context::inputs(const std::vector<std::filesystem::path>& others) const {
  std::set<std::filesystem::path> inputs = givenInputs(paths);
  inputs.insert(others.begin(), others.end());
  return inputs;
}

int integerOption(const std::string& name, const std::string& text, int low, int high) {
  const std::optional<int> value = parseInteger(text);
  if (value && *value >= low && *value <= high) return *value;
  const std::string range = high == std::numeric_limits<int>::max()
                                ? "of at least " + std::to_string(low)
                                : "from " + std::to_string(low) + " to " + std::to_string(high);
  usageError(name, "`" + text + "` is not an integer " + range);
}

int powerOfTwoOption(const std::string& name, const std::string& text, int low, int high) {
  const int value = integerOption(name, text, low, high);
  if (std::has_single_bit(static_cast<unsigned>(value))) return value;
  usageError(name, "`" + text + "` is not a power of two");
}

double positiveOption(const std::string& name, const std::string& text, double limit) {
  const std::optional<double> value = parseNumber(text);
  if (value && *value > 0 && *value < limit) return *value;
  const std::string below = limit < std::numeric_limits<double>::infinity() ? " and below " + toText(limit) : "";
  usageError(name, "`" + text + "` is not a number above 0" + below);
}

glm::dvec3 vectorOption(const std::string& name, const std::string& text) {
  const std::optional<glm::dvec3> value = parseVector(text);
  if (value) return *value;
  usageError(name, "`" + text + "` is not a vector x,y,z of three finite numbers");
}

Option addSeed(Command command, std::uint32_t& seed) {
  return addInteger(command, "--seed", seed, 0, std::numeric_limits<int>::max(),
                    "cast other random rays for each N, which gives independent estimates (default 0)");
}

Option addOutput(Command command, std::filesystem::path& output, const std::string& help) {
  return command.addOutputFolder("-o,--output", output, help).required();
}

}  // namespace hemitex::cli
