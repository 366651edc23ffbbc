/// `hemitex vector serve` draws the vectors that lines on stdin name: a device for `hemitex vector run --lines`.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/vector/vector_output.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;

struct ServeOptions {
  Device device = Device::Software;
  std::string deviceName;
};

/// Draws the vector that the line names into the folder behind the tab.
void drawLine(const std::string& line, const ServeOptions& options) {
  const std::size_t tab = line.find('\t');
  if (tab == std::string::npos)
    throw raster::InputError("a line names no folder for item IDs", "write it behind the vector and a tab");
  const reference::TestVector vector = reference::readVector(line.substr(0, tab));
  const std::vector<raster::ItemBuffer> buffers = drawVector(vector, options.device, options.deviceName);
  reference::writeCandidate(line.substr(tab + 1), vector, buffers);
}

void serve(const ServeOptions& options) {
  for (std::string line; std::getline(std::cin, line);) {
    try {
      drawLine(line, options);
      std::cout << "done" << std::endl;
    } catch (const raster::InputError& error) {
      std::cout << "failed: " << error.what() << std::endl;
    }
  }
}

}  // namespace

void addVectorServe(Command vector, Context& context) {
  const auto options = std::make_shared<ServeOptions>();
  const Command command = vector.addCommand(
      "serve", "Draw the vectors that lines on stdin name, each with a tab and a folder for item IDs");
  addDevice(command, options->device, options->deviceName);
  command.addExamples({"--device opengl", "--device vulkan"});
  command.onRead([options, &context] { context.command = [options] { serve(*options); }; });
}

}  // namespace hemitex::cli
