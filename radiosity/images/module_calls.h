/// Calls of the module for images. Its problems become InputError with the name of the file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/images/image_module.h"

namespace hemitex::radiosity {

/// As imageFunctions. Throws InputError where the module is not found.
const ImageFunctions& functionsFor(const std::filesystem::path& file);

void throwIfAny(const ImageProblem& problem, const std::filesystem::path& file);

/// Encodes in memory, so that a full disk is detected when the bytes are written, whatever the encoder does. See
/// ImageFunctions::encode.
std::vector<unsigned char> encode(const std::filesystem::path& file, const std::string& format,
                                  const std::string& colourSpace, const ImageSamples& samples);

/// Writes encoded samples. Throws InputError if the file cannot be written.
void writeBytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes);

/// A value of an EXR file. Throws InputError, which names the file, for a value that 32-bit floats cannot hold.
float floatOf(double value, const std::filesystem::path& file);

}  // namespace hemitex::radiosity
