/// Images: the sRGB curve compared with pow, and files that are read as they were written.
#include "radiosity/images/image.h"

#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// All 256 codes in red, the same in reverse order in green, and a third order in blue.
Image everyCode() {
  Image image{32, 8, {}};
  for (int code = 0; code < 256; ++code)
    image.pixels.emplace_back(decodeSrgb(code / 255.0), decodeSrgb((255 - code) / 255.0),
                              decodeSrgb((code * 37 % 256) / 255.0));
  return image;
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// One pixel of blue, green, red, alpha in Targa format: 18 bytes of header, then the pixel.
std::string targaPixel(const std::string& pixel) {
  std::string header(18, '\0');
  header[2] = 2;                                              // true colour, not compressed
  header[12] = header[14] = 1;                                // 1 x 1
  header[16] = static_cast<char>(8 * pixel.size());           // bits per pixel
  header[17] = static_cast<char>(pixel.size() == 4 ? 8 : 0);  // alpha bits
  return header + pixel;
}

}  // namespace

TEST_CASE("decodeSrgb and encodeSrgb agree with pow to the last digits", "[image]") {
  for (int i = 0; i <= 100000; ++i) {
    const double encoded = i / 100000.0;
    const double expected = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    REQUIRE(std::abs(decodeSrgb(encoded) - expected) <= 1e-15);
  }
  CHECK(decodeSrgb(0) == 0);
  CHECK(decodeSrgb(1) == 1);
}

TEST_CASE("encodeSrgb is the inverse of decodeSrgb for all codes, and clamps at both ends", "[image]") {
  for (int code = 0; code < 256; ++code) REQUIRE(encodeSrgb(decodeSrgb(code / 255.0)) == code);
  CHECK(encodeSrgb(-1) == 0);
  CHECK(encodeSrgb(2) == 255);
  CHECK(encodeSrgb(std::numeric_limits<double>::infinity()) == 255);
  CHECK(encodeSrgb(-std::numeric_limits<double>::infinity()) == 0);
  CHECK(encodeSrgb(std::numeric_limits<double>::quiet_NaN()) == 0);
}

TEST_CASE("encodeSrgb gives a linear value the code that is nearest in sRGB", "[image]") {
  for (int i = 0; i <= 10000; ++i) {
    const double encoded = i / 10000.0;
    const double distance = std::abs(encodeSrgb(decodeSrgb(encoded)) / 255.0 - encoded);
    REQUIRE(distance <= 0.5 / 255 + 1e-12);  // the tolerance is for rounding at the thresholds
  }
}

TEST_CASE("readImage reads a PNG as writePng wrote it, right way up", "[image]") {
  const TemporaryFolder folder;
  const Image written = everyCode();
  writePng(folder.path / "codes.png", written);
  const Image read = readImage(folder.path / "codes.png");
  CHECK(read.width == 32);
  CHECK(read.height == 8);
  CHECK(read.pixels == written.pixels);
}

TEST_CASE("writeExr keeps all floats, dark, bright and negative", "[image]") {
  const TemporaryFolder folder;
  const Image written{2, 2, {{0.1, 1e-30, 0}, {1e30, -3.5, 1}, {1.0 / 3, 2.0 / 3, 12345.678}, {-0.0, 65504, 65536}}};
  writeExr(folder.path / "values.exr", written);
  const Image read = readImage(folder.path / "values.exr");
  REQUIRE(read.pixels.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(read.pixels[i] == glm::dvec3(glm::vec3(written.pixels[i])));
}

TEST_CASE("writePng and writeExr give equal files for equal pixels at any time", "[image]") {
  const TemporaryFolder folder;
  writePng(folder.path / "a.png", everyCode());
  writeExr(folder.path / "a.exr", everyCode());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  writePng(folder.path / "b.png", everyCode());
  writeExr(folder.path / "b.exr", everyCode());
  CHECK(bytesOf(folder.path / "a.png") == bytesOf(folder.path / "b.png"));
  CHECK(bytesOf(folder.path / "a.exr") == bytesOf(folder.path / "b.exr"));
}

TEST_CASE("readImage converts grey to three channels and drops alpha without changing the colour", "[image]") {
  const TemporaryFolder folder;
  writeBytes(folder.path / "grey.pgm", std::string("P5 2 1 255\n\x00\xbc", 13));
  CHECK(readImage(folder.path / "grey.pgm").pixels[1] == glm::dvec3(decodeSrgb(188 / 255.0)));
  writeBytes(folder.path / "alpha.tga", targaPixel("\x10\x33\xff\x01"));
  CHECK(readImage(folder.path / "alpha.tga").pixels[0] == glm::dvec3(1, decodeSrgb(0.2), decodeSrgb(16 / 255.0)));
}

TEST_CASE("readImage takes more than 8 bits as linear", "[image]") {
  const TemporaryFolder folder;
  writeBytes(folder.path / "deep.ppm", std::string("P6 1 1 65535\n\x33\x33\0\0\x33\x33", 19));
  CHECK(glm::distance(readImage(folder.path / "deep.ppm").pixels[0], glm::dvec3(0.2, 0, 0.2)) < 1e-7);
}

TEST_CASE("readImage throws InputError for a file that is no image, or contains a NaN", "[image]") {
  const TemporaryFolder folder;
  writeBytes(folder.path / "text.png", "this is no image");
  CHECK_THROWS_AS(readImage(folder.path / "text.png"), raster::InputError);
  CHECK_THROWS_AS(readImage(folder.path / "absent.png"), raster::InputError);
  writeExr(folder.path / "whole.exr", everyCode());
  const std::string bytes = bytesOf(folder.path / "whole.exr");
  writeBytes(folder.path / "cut.exr", bytes.substr(0, bytes.size() / 2));
  CHECK_THROWS_AS(readImage(folder.path / "cut.exr"), raster::InputError);
  writeExr(folder.path / "nan.exr", Image{1, 1, {{0, std::numeric_limits<double>::quiet_NaN(), 0}}});
  CHECK_THROWS_AS(readImage(folder.path / "nan.exr"), raster::InputError);
}

TEST_CASE("decodeImage throws InputError for the beginnings of images", "[image]") {
  using namespace std::string_literals;
  for (const std::string& head :
       {"RIFF\x10\0\0\0WEBPVP8 "s, "\x89PNG\r\n\x1a\n\0\0\0\rIHDR"s, "\xff\xd8\xff\xe0\0\x10JFIF"s})
    for (std::size_t size = 0; size <= head.size(); ++size)
      CHECK_THROWS_AS(decodeImage({head.begin(), head.begin() + static_cast<std::ptrdiff_t>(size)}, "image"),
                      raster::InputError);
}

TEST_CASE("readImage takes no memory for attributes of an EXR file that are longer than the file", "[image]") {
  const TemporaryFolder folder;
  writeExr(folder.path / "a.exr", everyCode());
  const std::string bytes = bytesOf(folder.path / "a.exr");
  for (const char* size : {"\xff\xff\xff\x7f", "\xff\xff\xff\xff"}) {
    writeBytes(folder.path / "b.exr", bytes.substr(0, 8) + std::string("note\0string\0", 12) + size + bytes.substr(8));
    CHECK_THROWS_WITH(readImage(folder.path / "b.exr"), Catch::Contains("header promises more"));
  }
}

TEST_CASE("readImage ignores texts in PNG files, also those that are longer than the file", "[image]") {
  const TemporaryFolder folder;
  writePng(folder.path / "a.png", everyCode());
  const std::string bytes = bytesOf(folder.path / "a.png");
  constexpr std::size_t header = 33;  // signature and IHDR
  const auto withChunk = [&](const std::string& chunk) {
    writeBytes(folder.path / "b.png", bytes.substr(0, header) + chunk + bytes.substr(header));
    return readImage(folder.path / "b.png");
  };
  CHECK(withChunk(std::string("\0\0\0\3tEXta\0b????", 15)).pixels == readImage(folder.path / "a.png").pixels);
  CHECK_THROWS_AS(withChunk("\x7f\xff\xff\xfftEXta"), raster::InputError);
}

TEST_CASE("readImage knows PNG, JPEG and EXR files by their first bytes, and others by their names alone", "[image]") {
  const TemporaryFolder folder;
  writePng(folder.path / "a.png", everyCode());
  std::filesystem::copy(folder.path / "a.png", folder.path / "a.jpg");
  CHECK(readImage(folder.path / "a.jpg").pixels == readImage(folder.path / "a.png").pixels);
  const std::string grey("P5 2 1 255\n\x00\xbc", 13);
  writeBytes(folder.path / "grey.pgm", grey);
  CHECK_NOTHROW(readImage(folder.path / "grey.pgm"));
  for (const char* name : {"grey.png", "grey.exr", "grey", "grey.of-no-format"}) {
    writeBytes(folder.path / name, grey);
    CHECK_THROWS_AS(readImage(folder.path / name), raster::InputError);
  }
}

TEST_CASE("readImage throws InputError for an image with more pixels than memory can hold", "[image]") {
  const TemporaryFolder folder;
  writeBytes(folder.path / "huge.pgm", "P5 60000 60000 255\n");
  CHECK_THROWS_AS(readImage(folder.path / "huge.pgm"), raster::InputError);
}

TEST_CASE("readImage reduces an image of more than 2^24 pixels to means of linear values", "[image]") {
  const TemporaryFolder folder;
  constexpr int width = 6001, height = 4000;  // the sides are halved, the longer one rounded up
  std::string bytes = "P5 " + std::to_string(width) + " " + std::to_string(height) + " 255\n";
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) bytes += static_cast<char>((row + column) % 2 == 0 ? 255 : 0);
  writeBytes(folder.path / "chess.pgm", bytes);
  const Image chess = readImage(folder.path / "chess.pgm");
  CHECK(chess.width == 3001);
  CHECK(chess.height == 2000);
  REQUIRE(chess.pixels.size() == 3001 * 2000);
  // Each new pixel covers as many white as black ones: half the light, and not the light of half the code.
  CHECK(
      std::all_of(chess.pixels.begin(), chess.pixels.end(), [](const glm::dvec3& p) { return p == glm::dvec3(0.5); }));
}

TEST_CASE("readImage keeps an image of 2^24 pixels as it is", "[image]") {
  const TemporaryFolder folder;
  std::string bytes = "P5 4096 4096 255\n";
  for (int i = 0; i < 1 << 24; ++i) bytes += static_cast<char>(i * 7 % 251);
  writeBytes(folder.path / "full.pgm", bytes);
  const Image full = readImage(folder.path / "full.pgm");
  CHECK(full.width == 4096);
  REQUIRE(full.pixels.size() == std::size_t{1} << 24);
  bool isEqual = true;
  for (int i = 0; i < 1 << 24; ++i)
    isEqual = isEqual && full.pixels[static_cast<std::size_t>(i)] == glm::dvec3(decodeSrgb(i * 7 % 251 / 255.0));
  CHECK(isEqual);
}

TEST_CASE("readImage throws InputError for what is no regular file", "[image]") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder.path / "pipe.png").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(readImage(folder.path / "pipe.png"), Catch::Contains("is a pipe or a device"));
  CHECK_THROWS_WITH(readImage(folder.path), Catch::Contains("cannot be read: it is a folder"));
  CHECK_THROWS_WITH(readImage("/dev/zero"), Catch::Contains("is a pipe or a device"));
}

TEST_CASE("writePng throws InputError and leaves nothing behind if the file cannot be written", "[image]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(writePng(folder.path / "absent" / "a.png", everyCode()), raster::InputError);
  std::filesystem::create_directory(folder.path / "folder.png");
  CHECK_THROWS_AS(writePng(folder.path / "folder.png", everyCode()), raster::InputError);
  CHECK(std::filesystem::is_directory(folder.path / "folder.png"));
}

TEST_CASE("writePng reports a full disk, and does not remove other files", "[image]") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path / "full.png");
  CHECK_THROWS_AS(writePng(folder.path / "full.png", everyCode()), raster::InputError);
  CHECK(std::filesystem::is_symlink(folder.path / "full.png"));
}

TEST_CASE("writeExr refuses values above the range of 32 bits, and keeps others", "[image]") {
  const TemporaryFolder folder;
  const double most = std::numeric_limits<float>::max();
  writeExr(folder.path / "most.exr", Image{1, 1, {{most, -most, 0}}});
  CHECK(readImage(folder.path / "most.exr").pixels == std::vector{glm::dvec3(most, -most, 0)});
  CHECK_THROWS_WITH(writeExr(folder.path / "more.exr", Image{1, 1, {{0, 1.01 * most, 0}}}),
                    Catch::Contains("more.exr") && Catch::Contains("scale the light down"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "more.exr"));
}

TEST_CASE("writeExr of the channels R, G and B gives the file of an image", "[image]") {
  const TemporaryFolder folder;
  writeExr(folder.path / "image.exr", Image{2, 1, {{1, 2, 3}, {-4, 5e30, 0}}});
  writeExr(folder.path / "channels.exr", ChannelImage{2, 1, {"R", "G", "B"}, {1, 2, 3, -4, 5e30, 0}});
  CHECK(bytesOf(folder.path / "image.exr") == bytesOf(folder.path / "channels.exr"));
}

// readImage gives the first three channels of a file, which are R, G and B, or in the order of their names.
TEST_CASE("writeExr keeps the values of channels with any names", "[image]") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "bands.exr";
  writeExr(file, ChannelImage{1, 2, {"b_400", "b_500", "b_600"}, {1, 2, 3, 4, 5, 6}});
  CHECK(readImage(file).pixels == std::vector{glm::dvec3(1, 2, 3), glm::dvec3(4, 5, 6)});
  writeExr(file, ChannelImage{1, 1, {"R", "G", "B", "b_400", "b_500"}, {1, 2, 3, 4, 5}});
  CHECK(readImage(file).pixels == std::vector{glm::dvec3(1, 2, 3)});
  CHECK(bytesOf(file).find(std::string("b_500") + '\0') != std::string::npos);
  CHECK_THROWS_AS(writeExr(file, ChannelImage{1, 1, {"b_400"}, {1e39}}), raster::InputError);
}
