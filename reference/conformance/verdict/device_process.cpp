#include "reference/conformance/verdict/device_process.h"

#include <cstring>

#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

using raster::InputError;

std::size_t findQuoteEnd(const std::string& command, std::size_t quote) {
  const std::size_t end = command.find(command[quote], quote + 1);
  if (end == std::string::npos)
    throw InputError("the command " + command + " has a quote without an end", "close it or remove it");
  return end;
}

}  // namespace

std::vector<std::string> splitCommand(const std::string& command) {
  std::vector<std::string> words;
  bool isInWord = false;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const char c = command[k];
    const bool isBlank = c == ' ' || c == '\t' || c == '\n';
    if (!isBlank && !isInWord) words.emplace_back();
    isInWord = !isBlank;
    if (c == '\'' || c == '"') {
      const std::size_t end = findQuoteEnd(command, k);
      words.back() += command.substr(k + 1, end - k - 1);
      k = end;
    } else if (!isBlank) {
      words.back() += c;
    }
  }
  if (words.empty() || words[0].empty()) throw InputError("the command names no program");
  return words;
}

std::vector<std::string> fillCommand(const std::vector<std::string>& words, const std::string& vector,
                                     const std::string& output) {
  const std::string vectorMark = "{vector}", outputMark = "{output}";
  std::vector<std::string> filled;
  for (const std::string& word : words) {
    std::string& result = filled.emplace_back();
    for (std::size_t k = 0; k < word.size();) {
      const bool isVector = word.compare(k, vectorMark.size(), vectorMark) == 0;
      const bool isOutput = word.compare(k, outputMark.size(), outputMark) == 0;
      result += isVector ? vector : isOutput ? output : word.substr(k, 1);
      k += isVector ? vectorMark.size() : isOutput ? outputMark.size() : 1;
    }
  }
  return filled;
}

DeviceFailure failureOf(const ProcessResult& process) {
  if (process.isTimedOut) return {DeviceFault::TimeLimit, "stopped at the time limit", process};
  if (process.signal == 0)
    return {DeviceFault::ExitCode, "ended with exit code " + std::to_string(process.exitCode), process};
  return {DeviceFault::Crash,
          "ended by signal " + std::to_string(process.signal) + " (" + strsignal(process.signal) + ")", process};
}

}  // namespace hemitex::reference
