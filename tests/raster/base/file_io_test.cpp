// Whole files: what writeFile writes, readFile reads.
#include "raster/base/file_io.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using raster::InputError;

TEST_CASE("readFile and tryReadFile return the bytes that writeFile wrote", "[file_io]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "bytes";
  for (const std::string& bytes : {std::string("a\r\n\0b", 5), std::string(), std::string(100'000, 'x')}) {
    raster::writeFile(file, bytes);
    CHECK(raster::readFile(file) == bytes);
    CHECK(raster::tryReadFile(file) == bytes);
  }
}

TEST_CASE("tryReadFile returns nothing for what is no regular file", "[file_io]") {
  const TemporaryFolder folder;
  CHECK_FALSE(raster::tryReadFile(folder.path / "missing"));
  CHECK_FALSE(raster::tryReadFile(folder.path));
  CHECK_FALSE(raster::tryReadFile("/dev/zero"));
}

TEST_CASE("openFile and readFile do not wait for a pipe or a device, and say what it is", "[file_io]") {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path / "pipe.csv";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  for (const std::filesystem::path& other : {pipe, std::filesystem::path("/dev/zero")}) {
    CHECK_FALSE(raster::tryOpenFile(other));
    CHECK_THROWS_WITH(raster::openFile(other), other.string() + ": is a pipe or a device, not a file");
    CHECK_THROWS_WITH(raster::readFile(other), other.string() + ": is a pipe or a device, not a file");
  }
  CHECK_THROWS_WITH(raster::openFile(folder.path, "give a file"),
                    folder.path.string() + ": cannot be read: it is a folder; give a file");
}

TEST_CASE("tryReadFile refuses a file that is larger than the free memory", "[file_io]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "large";
  raster::writeFile(file, "");
  std::filesystem::resize_file(file, std::uint64_t{1} << 42);  // a hole
  CHECK_THROWS_WITH(raster::tryReadFile(file), Catch::Contains("large: the file takes about 4.4e+03 GB of memory"));
}

TEST_CASE("readFile reports file and advice", "[file_io]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "missing";
  try {
    raster::readFile(file, "give another one");
    FAIL("no exception");
  } catch (const InputError& error) {
    CHECK(error.file() == file.string());
    CHECK(error.advice() == "give another one");
  }
}

TEST_CASE("writeFile reports a file that it cannot write, and leaves none", "[file_io]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(raster::writeFile(folder.path / "no folder" / "file", "bytes"), InputError);
  CHECK_THROWS_AS(raster::writeFile(folder.path, "bytes"), InputError);
  CHECK(std::filesystem::is_empty(folder.path));
}

TEST_CASE("writeFile reports a full device", "[file_io]") {
  CHECK_THROWS_AS(raster::writeFile("/dev/full", "bytes"), InputError);
}
