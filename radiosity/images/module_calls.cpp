#include "radiosity/images/module_calls.h"

#include <limits>
#include <stdexcept>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {

using namespace std::string_literals;

const ImageFunctions& functionsFor(const std::filesystem::path& file) try {
  return imageFunctions();
} catch (const raster::InputError&) {
  throw;
} catch (const std::runtime_error& error) {
  throw raster::InputError(file.string(), 0, "needs the module for images, which cannot be opened: "s + error.what(),
                           "install hemitex again, or build it with CMake");
}

void throwIfAny(const ImageProblem& problem, const std::filesystem::path& file) {
  if (!problem.problem.empty()) throw raster::InputError(file.string(), 0, problem.problem, problem.advice);
}

std::vector<unsigned char> encode(const std::filesystem::path& file, const std::string& format,
                                  const std::string& colourSpace, const ImageSamples& samples) {
  std::vector<unsigned char> bytes;
  throwIfAny(functionsFor(file).encode(format, colourSpace, samples, bytes), file);
  return bytes;
}

void writeBytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
  raster::writeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

float floatOf(double value, const std::filesystem::path& file) {
  if (value > std::numeric_limits<float>::max())
    throw raster::InputError(file.string(), 0, "cannot hold a value above 3.4e38", "scale the light down");
  return static_cast<float>(value);
}

}  // namespace hemitex::radiosity
