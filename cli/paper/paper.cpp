/// `hemitex paper`: measures the tables of Nielsen and Christensen (2002) again and draws the figures.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/program.h"
#include "cli/common/staging.h"
#include "cli/devices/row_device.h"
#include "cli/paper/figures.h"
#include "cli/report/paper_report.h"
#include "raster/base/file_io.h"
#include "raster/base/parallel.h"
#include "reference/base/stopwatch.h"
#include "reference/measurement/paper/scenes.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

struct PaperOptions {
  std::filesystem::path output;
  RowDevice device;
};

/// The reference renderer and a device: the chosen one or, if there is one, OpenGL.
std::vector<reference::PaperDevice> devices(const RowDevice& chosen, Console& console) {
  constexpr std::size_t maxMeshElements = 500000;
  std::vector<reference::PaperDevice> devices{{"software", radiosity::softwareRenderer}};
  if (chosen.device != Device::Software) {
    devices.push_back({nameOf(reference::rowDevices(), chosen.device), rowRenderers(chosen, console), maxMeshElements});
  } else if (const RendererMaker openGl =
                 openGlRenderers(Device::OpenGl, console, "the tables have no hardware columns")) {
    devices.push_back({"opengl", openGl, maxMeshElements});
    console.message("a graphics card idles while the processor sums rows, and its clock falls: its times are longer");
  }
  return devices;
}

void makePaper(const PaperOptions& options, Context& context) {
  Console& console = context.console;
  const reference::Stopwatch all;
  Staging staging({.place = options.output, .writer = "paper"});
  const std::vector<reference::PaperDevice> measured = devices(options.device, console);
  const auto progress = [&console](double fraction, const std::string& what) { console.progress(fraction, what); };
  // The paper measured on one processor. More threads would hide the cost of the serial parts.
  const raster::ThreadLimit oneProcessor(1);
  const std::vector<reference::PaperScene> scenes = reference::paperScenes(sceneFolder());
  const std::vector<reference::PaperRun> runs = reference::measurePaperRuns(scenes, measured, {}, progress);
  ordered_json result = paperJson(runs);
  result["phantoms"] = phantomsJson(scenes);
  result["figures"] = writePaperFigures(sceneFolder(), scenes, staging.folder(),
                                        [&console](const std::string& what) { console.progress(1, what); });
  console.endProgress();
  result["warnings"] = console.given();
  result["times"] = {{"all_s", all.seconds()}};
  raster::writeFile(staging.folder() / "paper.json", toText(result));
  raster::writeFile(staging.folder() / "report.html", paperPage(result, staging.folder()));
  staging.commit();
  std::cout << (context.json ? toText(result) : paperText(result));
}

}  // namespace

void addPaper(Command program, Context& context) {
  const auto options = std::make_shared<PaperOptions>();
  const Command command =
      program.addCommand("paper", "Measure the tables of the paper again and draw its figures (takes minutes)");
  addOutput(command, options->output, "write report.html, paper.json and the pictures into this folder");
  addRowDevice(command, options->device);
  command.addExamples({"-o paper", "-o paper --device vulkan --json --threads 1"});
  command.onRead([options, &context] { context.command = [options, &context] { makePaper(*options, context); }; });
}

}  // namespace hemitex::cli
