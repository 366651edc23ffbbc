/// `vector render` draws the item buffers of a test vector.
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/staging.h"
#include "cli/vector/vector_output.h"
#include "reference/conformance/trace/stage_dump.h"

namespace hemitex::cli {
namespace {

struct RenderOptions {
  std::filesystem::path input, output;
  Device device = Device::Software;
  std::string deviceName;
  bool stages = false;
};

/// The files of the vector, if it is rendered in place.
std::set<std::string> ownFiles(const RenderOptions& options) {
  std::set<std::string> names;
  std::error_code isOther;
  if (!std::filesystem::equivalent(options.input, options.output, isOther)) return names;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(options.input))
    if (const auto type = entry.path().extension(); type == ".f32" || type == ".u16" || type == ".u32")
      names.insert(entry.path().filename());
  names.insert("vector.json");
  return names;
}

void renderVector(const RenderOptions& options, Context& context) {
  reference::TestVector vector = reference::readVector(options.input);
  const std::vector<raster::ItemBuffer> buffers = drawVector(vector, options.device, options.deviceName);
  if (options.device != Device::Software)
    context.console.message("drawn by " + deviceName(options.device, options.deviceName));
  for (std::size_t f = 0; f < buffers.size(); ++f) vector.faces[f].hash = reference::faceHash(vector, buffers[f]);
  Staging staging({.place = options.output, .writer = "vector render", .replaced = ownFiles(options)});
  reference::writeVector(staging.folder(), vector, buffers);
  if (options.stages) reference::writeStages(staging.folder(), vector);
  staging.commit();
  printFaces(vector, context);
}

}  // namespace

void addVectorRender(Command vector, Context& context) {
  const auto options = std::make_shared<RenderOptions>();
  const Command command = vector.addCommand("render", "Draw the item IDs of a test vector by the raster rules");
  command.addPath("DIR", options->input, "folder of the vector").required();
  addDevice(command, options->device, options->deviceName);
  addStages(command, options->stages);
  addOutput(command, options->output, "write the vector with its item IDs into this folder, which may be DIR");
  command.addExamples({"suite/fans-later-nearer -o drawn/fans-later-nearer", "vector -o drawn --device opengl"});
  command.onRead([options, &context] { context.command = [options, &context] { renderVector(*options, context); }; });
}

}  // namespace hemitex::cli
