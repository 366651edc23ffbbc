#include "raster/base/memory_budget.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "raster/base/short_number.h"

namespace hemitex::raster {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

struct Policy {
  bool insists = false;
  std::string howToInsist;
};

/// What the innermost SizePolicy says.
Policy& policy() {
  static Policy value;
  return value;
}

std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return a - std::min(a, b); }

/// The number behind a name in a file of lines `name number`.
std::optional<std::uint64_t> numberIn(const std::filesystem::path& file, const std::string& wanted) {
  std::ifstream stream(file);
  for (std::string name; stream >> name; stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (std::uint64_t number = 0; name == wanted && stream >> number) return number;
  return std::nullopt;
}

/// The number that a file consists of; nothing for the word `max`, or without the file.
std::optional<std::uint64_t> numberOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (std::uint64_t number = 0; stream >> number) return number;
  return std::nullopt;
}

std::uint64_t freeInSystem(const std::filesystem::path& root) {
  const auto kibibytes = numberIn(root / "proc/meminfo", "MemAvailable:");
  return kibibytes ? *kibibytes << 10 : unlimited;
}

/// Pages of files that were not used lately are dropped where a group needs memory.
std::uint64_t freeInGroup(const std::filesystem::path& group) {
  const auto limit = numberOf(group / "memory.max"), used = numberOf(group / "memory.current");
  if (!limit || !used) return unlimited;
  return difference(*limit, difference(*used, numberIn(group / "memory.stat", "inactive_file").value_or(0)));
}

/// The limits of all groups above the process count.
std::uint64_t freeInGroups(const std::filesystem::path& root) {
  std::ifstream lines(root / "proc/self/cgroup");
  std::uint64_t least = unlimited;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("0::/")) continue;  // the line of version 2
    std::filesystem::path group = root / "sys/fs/cgroup";
    least = std::min(least, freeInGroup(group));
    for (const std::filesystem::path& name : std::filesystem::path(line.substr(4))) {
      group /= name;
      least = std::min(least, freeInGroup(group));
    }
  }
  return least;
}

/// As requireMemory for the rest of what takes `total` bytes.
void requireFree(std::uint64_t bytes, std::uint64_t total, const std::string& file, const std::string& what,
                 const std::string& advice) {
  if (bytes < smallRequest || policy().insists) return;
  const std::optional<std::uint64_t> available = freeMemory();
  if (!available || bytes <= difference(*available, memoryReserve)) return;
  refuseSize(file,
             what + " takes about " + memoryText(total) + " of memory; " +
                 memoryText(difference(*available, memoryReserve)) + " are free",
             advice);
}

}  // namespace

std::uint64_t freeAddressSpace(const std::filesystem::path& root) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const std::uint64_t pages = numberOf(root / "proc/self/statm").value_or(0);
  return difference(limit.rlim_cur, pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

std::optional<std::uint64_t> freeMemory(const std::filesystem::path& root) {
  const std::uint64_t least = std::min({freeInSystem(root), freeAddressSpace(root), freeInGroups(root)});
  return least == unlimited ? std::nullopt : std::optional(least);
}

void requireMemory(std::uint64_t bytes, const std::string& file, const std::string& what, const std::string& advice) {
  requireFree(bytes, bytes, file, what, advice);
}

void refuseSize(const std::string& file, const std::string& what, const std::string& advice) {
  const auto& [insists, how] = policy();
  if (insists) return;
  throw SizeError(file, 0, what, advice + (advice.empty() || how.empty() ? "" : ", or ") + how);
}

RunningRequest::RunningRequest(std::string file, std::string what) : file_(std::move(file)), what_(std::move(what)) {}

void RunningRequest::add(std::uint64_t bytes) {
  total_ = saturatedSum(total_, bytes);
  sinceLook_ = saturatedSum(sinceLook_, bytes);
  if (sinceLook_ < smallRequest) return;
  requireFree(sinceLook_, total_, file_, what_, {});
  sinceLook_ = 0;
}

SizePolicy::SizePolicy(bool insists, std::string howToInsist)
    : insistedBefore_(policy().insists), howBefore_(std::move(policy().howToInsist)) {
  policy() = {insists, std::move(howToInsist)};
}

SizePolicy::~SizePolicy() { policy() = {insistedBefore_, std::move(howBefore_)}; }

std::string memoryText(std::uint64_t bytes) {
  constexpr double mega = 1e6, giga = 1e9;
  const auto number = static_cast<double>(bytes);
  return number < 0.9995 * giga ? shortNumber(number / mega) + " MB" : shortNumber(number / giga) + " GB";
}

}  // namespace hemitex::raster
