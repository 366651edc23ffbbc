// namedFile finds files that were named on other systems.
#include "radiosity/base/named_file.h"

#include <catch2/catch.hpp>

#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

TEST_CASE("namedFile finds a file with backslashes, quotes, other letters, or folders of another machine", "[files]") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path / "Maps" / "old ones");
  const std::filesystem::path file = folder.path / "Maps" / "old ones" / "Wood A.PNG", beside = folder.path / "b.png";
  tests::writeAll(file, "");
  tests::writeAll(beside, "");
  for (const char* name :
       {"Maps/old ones/Wood A.PNG", "Maps\\old ones\\Wood A.PNG", "maps/OLD ones/wood a.png",
        "\"Maps/old ones/Wood A.PNG\"", "'maps\\old ones\\wood a.png'", ".\\Maps\\old ones\\Wood A.PNG",
        "C:\\Users\\x\\Maps\\old ones\\Wood A.PNG", "/home/x/maps/old ones/Wood A.PNG",
        "textures/../Maps/old ones/Wood A.PNG", "Maps\\\\old ones\\Wood A.PNG"}) {
    CAPTURE(name);
    const auto found = namedFile(folder.path, name);
    REQUIRE(found);
    CHECK(std::filesystem::equivalent(*found, file));
  }
  CHECK(namedFile(folder.path, "D:\\B.png") == beside);
  for (const char* name : {"", "Maps", "none.png", "Wood A.PNG", "\"", "..", "/"}) {
    CAPTURE(name);
    CHECK_FALSE(namedFile(folder.path, name));
  }
}
