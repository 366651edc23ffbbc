// The budget of memory: what is free, and what requireMemory grants of it.
#include "raster/base/memory_budget.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "raster/base/file_io.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using Catch::Contains;

namespace {

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  raster::writeFile(file, text);
}

}  // namespace

TEST_CASE("freeMemory is that of the system, or what a control group above the process leaves", "[memory]") {
  const TemporaryFolder folder;
  CHECK_FALSE(raster::freeMemory(folder.path));
  write(folder.path / "proc/meminfo", "MemTotal: 900 kB\nMemAvailable:  500 kB\nSwapFree: 7 kB\n");
  CHECK(raster::freeMemory(folder.path) == 500u << 10);

  write(folder.path / "proc/self/cgroup", "4:memory:/old\n0::/outer/inner\n");
  const std::filesystem::path outer = folder.path / "sys/fs/cgroup/outer";
  write(outer / "inner/memory.max", "max\n");
  write(outer / "inner/memory.current", "90000\n");
  CHECK(raster::freeMemory(folder.path) == 500u << 10);
  write(outer / "memory.max", "100000\n");
  write(outer / "memory.current", "90000\n");
  CHECK(raster::freeMemory(folder.path) == 10000);
  write(outer / "memory.stat", "anon 5\ninactive_file 30000\n");
  CHECK(raster::freeMemory(folder.path) == 40000);
  write(outer / "inner/memory.max", "80000");
  CHECK(raster::freeMemory(folder.path) == 0);
}

TEST_CASE("saturatedProduct and saturatedSum are the largest number where the result is larger", "[memory]") {
  CHECK(raster::saturatedProduct(3, 4u, std::size_t{5}) == 60);
  CHECK(raster::saturatedProduct(largest, 2) == largest);
  CHECK(raster::saturatedProduct(std::uint64_t{1} << 40, std::uint64_t{1} << 40, 8) == largest);
  CHECK(raster::saturatedProduct(largest, 2, 0) == 0);
  CHECK(raster::saturatedSum(largest - 1, 1) == largest);
  CHECK(raster::saturatedSum(largest, 7) == largest);
}

TEST_CASE("requireMemory names the file, what takes the memory, and how much", "[memory]") {
  CHECK_NOTHROW(raster::requireMemory(1000, "a.ply", "the mesh"));
  CHECK_NOTHROW(raster::requireMemory(raster::smallRequest, "a.ply", "the mesh"));
  CHECK_THROWS_WITH(raster::requireMemory(largest / 4, "a.ply", "the mesh", "divide it"),
                    Contains("a.ply: the mesh takes about 4.61e+09 GB of memory; ") && Contains(" free; divide it"));
  CHECK_THROWS_AS(raster::requireMemory(largest, "", "the mesh"), raster::SizeError);
}

TEST_CASE("RunningRequest refuses a sum of requests that are each granted", "[memory]") {
  raster::RunningRequest request("a.obj", "the set of its images");
  request.add(raster::smallRequest - 1);
  request.add(raster::smallRequest);
  CHECK_THROWS_WITH(request.add(largest), Contains("a.obj: the set of its images takes about 1.84e+10 GB of memory; "));
}

TEST_CASE("refuseSize and requireMemory refuse nothing while a SizePolicy insists", "[memory]") {
  {
    const raster::SizePolicy policy(false, "insist");
    CHECK_THROWS_WITH(raster::refuseSize("", "it is large", "make it smaller"),
                      "it is large; make it smaller, or insist");
    CHECK_THROWS_WITH(raster::refuseSize("", "it is large"), "it is large; insist");
    {
      const raster::SizePolicy inner(true, "");
      CHECK_NOTHROW(raster::refuseSize("", "it is large"));
      CHECK_NOTHROW(raster::requireMemory(largest, "", "it"));
    }
    CHECK_THROWS_WITH(raster::refuseSize("", "it is large"), "it is large; insist");
  }
  CHECK_THROWS_WITH(raster::refuseSize("", "it is large"), "it is large");
}

TEST_CASE("memoryText has three digits and a unit", "[memory]") {
  CHECK(raster::memoryText(16'700'000) == "16.7 MB");
  CHECK(raster::memoryText(999'900'000) == "1 GB");
  CHECK(raster::memoryText(2'340'000'000) == "2.34 GB");
}
