// SHA-256 against the examples of FIPS 180-2 (2002), appendix B.
#include "reference/base/hashes/sha256.h"

#include <catch2/catch.hpp>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using hemitex::reference::sha256;
using hemitex::reference::sha256OfFile;

TEST_CASE("sha256 gives the digests of the standard", "[records]") {
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256(std::string(1000000, 'a')) == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("sha256OfFile gives the digest of a file's bytes, whatever their number", "[records]") {
  const hemitex::TemporaryFolder folder;
  for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 1000000u}) {
    const std::string bytes(size, 'a');
    hemitex::raster::writeFile(folder.path / "file", bytes);
    CHECK(sha256OfFile(folder.path / "file") == sha256(bytes));
  }
  CHECK_THROWS_AS(sha256OfFile(folder.path / "missing"), hemitex::raster::InputError);
  CHECK_THROWS_AS(sha256OfFile("/dev/zero"), hemitex::raster::InputError);
}
