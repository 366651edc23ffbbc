/// `hemitex vector serve` draws the vectors that lines on stdin name: a device for `hemitex vector run --lines`.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/devices/renderers.h"
#include "cli/vector/vector_output.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;

/// Draws the vector that the line names into the folder behind the tab.
void drawLine(const std::string& line, Device device) {
  const std::size_t tab = line.find('\t');
  if (tab == std::string::npos)
    throw raster::InputError("a line names no folder for item IDs", "write it behind the vector and a tab");
  const reference::TestVector vector = reference::readVector(line.substr(0, tab));
  reference::writeCandidate(line.substr(tab + 1), vector, render(*makeRenderer(vector.list, device), facesOf(vector)));
}

void serve(Device device) {
  for (std::string line; std::getline(std::cin, line);) {
    try {
      drawLine(line, device);
      std::cout << "done" << std::endl;
    } catch (const raster::InputError& error) {
      std::cout << "failed: " << error.what() << std::endl;
    }
  }
}

}  // namespace

void addVectorServe(Command vector, Context& context) {
  const auto device = std::make_shared<Device>(Device::Software);
  const Command command = vector.addCommand(
      "serve", "Draw the vectors that lines on stdin name, each with a tab and a folder for item IDs");
  addDevice(command, *device);
  command.addExamples({"--device opengl", "--device vulkan"});
  command.onRead([device, &context] { context.command = [device] { serve(*device); }; });
}

}  // namespace hemitex::cli
