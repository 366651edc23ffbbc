/// `hemitex vector calibrate` measures the profile of a device. It first writes probing vectors. From the item buffers
/// that the device draws for them it computes the profile that `vector check` uses.
#include <iostream>
#include <memory>
#include <optional>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "cli/vector/profile_page.h"
#include "cli/vector/vector_output.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/conformance/calibration/calibration.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::cli {
namespace {

namespace filesystem = std::filesystem;
using Json = nlohmann::ordered_json;

struct CalibrateOptions {
  filesystem::path probes;                      ///< folder to write probing vectors into
  filesystem::path vectors, candidate, output;  ///< probing vectors, item buffers of the device, profile
  filesystem::path page;                        ///< of the profile
  std::string device = "a device";              ///< its name on the page
};

void writeProbes(const filesystem::path& folder, const Context& context) {
  const std::vector<reference::TestVector> vectors = vectorsOf(reference::makeProbes());
  writeVectors(
      folder, "vector calibrate --probes", vectors.size(), [&vectors](std::size_t k) { return vectors[k]; }, false,
      context);
}

/// A profile follows only from item buffers for the probes of this program version.
void requireSame(const filesystem::path& folder, const reference::TestVector& probe) {
  const reference::TestVector drawn = reference::readVector(folder);
  if (drawn.list.positions != probe.list.positions || drawn.list.texcoords != probe.list.texcoords)
    throw raster::InputError(folder.string(), 0, "differs from the probing vector of this program",
                             "write the probing vectors again with vector calibrate --probes, and draw them");
}

void calibrateDevice(const CalibrateOptions& options, Context& context) {
  Staging staging({Output::Kind::File, options.output, "vector calibrate", context.inputs()});
  staging.requirePlaces({options.output.filename()});
  std::optional<Staging> page;
  if (!options.page.empty()) {
    page.emplace(Output{Output::Kind::File, options.page, "vector calibrate --html", context.inputs()});
    page->requirePlaces({options.page.filename()});
  }
  const reference::ProbingSet probes = reference::makeProbes();
  std::vector<raster::ItemBuffer> answers;
  for (const reference::TestVector& probe : vectorsOf(probes)) {
    requireSame(options.vectors / probe.name, probe);
    answers.push_back(reference::readCandidate(options.candidate / probe.name, probe).front());
  }
  const reference::Calibration calibration = reference::calibrate(probes, answers);
  context.failed = !calibration.faults.empty();
  const Json profile = toJson(calibration.profile);
  if (!context.failed) {
    raster::writeFile(staging.file(), toText(profile));
    if (page) raster::writeFile(page->file(), toHtml({options.device, probes, answers, calibration}));
    staging.commit();
    if (page) page->commit();
  }
  if (context.json) {
    std::cout << toText({{"profile", context.failed ? Json() : profile}, {"faults", calibration.faults}});
  } else if (context.failed) {
    for (const std::string& fault : calibration.faults) std::cout << fault << '\n';
  } else {
    writeCsv(std::cout, tableOf(listOf(profile.items(), [](const auto& entry) -> Json {
               const Json& value = entry.value();
               return {{"key", entry.key()}, {"value", value.is_string() ? value : Json(value.dump())}};
             })));
  }
}

}  // namespace

void addVectorCalibrate(Command vector, Context& context) {
  const auto options = std::make_shared<CalibrateOptions>();
  const Command command = vector.addCommand("calibrate", "Measure the profile of a device, for vector check --profile");
  const Option probes =
      command.addOutputFolder("--probes", options->probes, "write the probing vectors into this folder");
  const Option folder =
      command.addPath("DIR", options->vectors, "folder of the probing vectors, written with --probes");
  const Option candidate = command.addPath("--candidate", options->candidate, "folder with the device's item IDs");
  const Option output = command.addOutputFile("-o,--output", options->output, "write the profile into this JSON file");
  const Option page = command.addOutputFile(
      "--html", options->page, "write an HTML page of the profile with a picture per property, to publish");
  command.addText("--device-name", "NAME", "the device, for the page", options->device).needs(page);
  page.needs(folder);
  folder.needs(candidate).needs(output).excludes(probes);
  candidate.needs(folder);
  output.needs(folder);
  command.addExamples({"--probes probes",
                       "probes --candidate drawn -o profile.json --html profile.html --device-name 'My GPU'"});
  command.onRead([options, &context] {
    if (options->probes.empty() && options->vectors.empty())
      usageError("calibrate", "give --probes FOLDER, or DIR with --candidate and -o");
    context.command = [options, &context] {
      if (options->vectors.empty())
        writeProbes(options->probes, context);
      else
        calibrateDevice(*options, context);
    };
  });
}

}  // namespace hemitex::cli
