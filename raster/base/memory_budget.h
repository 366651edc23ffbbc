/// The budget of memory: what readers of files and other large allocations may take. They ask before they allocate, so
/// that a small file that promises much ends with a message, and the machine keeps its memory for other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "raster/base/input_error.h"

namespace hemitex::raster {

/// The bytes that this process can still allocate without swapping: the minimum of what the system has, what the limit
/// of its address space leaves (RLIMIT_AS), and what the control groups of version 2 above it leave. Nothing where the
/// system says none of them. `root` is the folder that holds `proc` and `sys`.
std::optional<std::uint64_t> freeMemory(const std::filesystem::path& root = "/");

/// What the limit of the address space leaves; the largest number without a limit.
std::uint64_t freeAddressSpace(const std::filesystem::path& root = "/");

/// The part of the free memory that is never promised: stacks of threads, shared libraries that are opened later, and
/// the many small allocations that are not counted.
inline constexpr std::uint64_t memoryReserve = std::uint64_t{64} << 20;

/// Smaller requests are granted without a look at the system, so that small files cost no time.
inline constexpr std::uint64_t smallRequest = std::uint64_t{16} << 20;

/// The product of numbers that a file states; the largest number where it is larger.
template <typename... Factors>
std::uint64_t saturatedProduct(std::uint64_t first, Factors... factors) {
  std::uint64_t product = first;
  const auto multiply = [&product](std::uint64_t factor) {
    if (__builtin_mul_overflow(product, factor, &product)) product = std::numeric_limits<std::uint64_t>::max();
  };
  (multiply(static_cast<std::uint64_t>(factors)), ...);
  return product;
}

/// The sum of two numbers; the largest number where it is larger.
inline std::uint64_t saturatedSum(std::uint64_t a, std::uint64_t b) {
  std::uint64_t sum = 0;
  return __builtin_add_overflow(a, b, &sum) ? std::numeric_limits<std::uint64_t>::max() : sum;
}

/// What is too large for an ordinary run. Readers that make do without a file pass this error on, so that a result does
/// not depend on the free memory.
class SizeError : public InputError {
  using InputError::InputError;
};

/// Throws SizeError, which names `file` unless it is empty, unless `bytes` are free beside the reserve or the user
/// insists. `what` is the subject of the message, in the singular, such as `the image wood.png`.
void requireMemory(std::uint64_t bytes, const std::string& file, const std::string& what,
                   const std::string& advice = {});

/// Throws SizeError for something else that is too large, unless the user insists.
void refuseSize(const std::string& file, const std::string& what, const std::string& advice = {});

/// Many requests of one reader, which may each be small: looks at the system once per smallRequest bytes.
class RunningRequest {
 public:
  /// `what` is as for requireMemory.
  explicit RunningRequest(std::string file, std::string what);

  /// To be called before the bytes are allocated. Throws SizeError as requireMemory.
  void add(std::uint64_t bytes);

 private:
  std::string file_, what_;
  std::uint64_t total_ = 0, sinceLook_ = 0;
};

/// During its lifetime: whether the user insists, so that nothing is refused for its size; and how a user can insist,
/// for the advice in messages, such as `add --insist to run all the same`. Front ends set it, for all threads.
class SizePolicy {
 public:
  SizePolicy(bool insists, std::string howToInsist);
  ~SizePolicy();
  SizePolicy(const SizePolicy&) = delete;
  SizePolicy& operator=(const SizePolicy&) = delete;

 private:
  bool insistedBefore_;
  std::string howBefore_;
};

/// Bytes for people, such as `1.25 GB`.
std::string memoryText(std::uint64_t bytes);

}  // namespace hemitex::raster
