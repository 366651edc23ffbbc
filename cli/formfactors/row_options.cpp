#include "cli/formfactors/row_options.h"

#include <algorithm>

#include "cli/common/json.h"
#include "cli/scene/symmetry_options.h"

namespace hemitex::cli {

using reference::RowMethod;
using reference::RowReceivers;
using reference::SparseRow;

namespace {

/// The settings of the method that the JSON output repeats.
nlohmann::ordered_json methodSettings(const FormFactorOptions& options) {
  if (options.method == "rays")
    return {{"method", options.method},
            {"samples", options.rays.samples},
            {"seed", options.rays.seed},
            {"aimed", options.rays.aimed}};
  if (options.method == "analytic") return {{"method", options.method}, {"blockers_ignored", true}};
  if (options.maxError) return {{"method", options.method}, {"max_error", *options.maxError}};
  nlohmann::ordered_json settings{{"method", options.method}};
  settings.update(toJson(options.drawing));
  if (options.device.device != Device::Software)
    settings["device"] = deviceName(options.device.device, options.device.name);
  return settings;
}

}  // namespace

RowMethod methodOf(const FormFactorOptions& options, const radiosity::Scene& scene,
                   const radiosity::Discretization& discretization, const RowReceivers& receivers, Context& context) {
  if (options.maxError) return reference::facetMethod(scene, receivers, *options.maxError, context.ranks ? 1 : 256);
  if (options.method == "rays") return reference::rayMethod(scene, discretization, receivers, options.rays);
  if (options.method == "analytic") return reference::analyticMethod(scene, discretization, receivers);
  return reference::drawnMethod(scene, discretization, receivers, layoutOf(options.id, discretization), options.drawing,
                                rowRenderers(options.device, context.console));
}

nlohmann::ordered_json settingsOf(const FormFactorOptions& options) {
  nlohmann::ordered_json settings = methodSettings(options);
  if (const auto& symmetry = options.scene.settings.symmetry; !symmetry.isNone())
    settings["symmetry"] = toJson(symmetry);
  return settings;
}

Table tableOf(const std::vector<SparseRow>& rows, std::size_t receivers, std::vector<std::string> columns,
              const std::function<std::vector<Cell>(std::size_t)>& names) {
  const bool hasErrors = !rows.front().error.empty();
  columns.emplace_back("form_factor");
  if (hasErrors) columns.emplace_back("standard_error");
  const auto cells = [&rows, names, receivers, hasErrors](std::size_t index) {
    const SparseRow& row = rows[index / receivers];
    const std::optional<std::size_t> entry = row.placeOf(index % receivers);
    std::vector<Cell> line = names(index);
    line.emplace_back(entry ? row.value[*entry] : 0.0);
    if (hasErrors) line.emplace_back(entry ? row.error[*entry] : 0.0);
    return line;
  };
  return {columns, rows.size() * receivers, cells};
}

void tellCaptured(const RowMethod& method, Console& console) {
  if (method.captured && *method.captured < 1)
    console.message("the projection captures " + percentText(*method.captured) +
                    " of the light; the rest counts as leaving the scene");
}

void warnOfBacks(const std::vector<double>& backs, const std::vector<std::string>& names, Console& console) {
  constexpr double limit = 0.01;
  const auto most = std::max_element(backs.begin(), backs.end());
  if (most == backs.end() || *most <= limit) return;
  const auto rows = std::count_if(backs.begin(), backs.end(), [&](double share) { return share > limit; });
  console.warning("backs of faces take more than 1 % of " + (rows == 1 ? "a row" : std::to_string(rows) + " rows") +
                  ", most of the row of " + names[static_cast<std::size_t>(most - backs.begin())] + ": " +
                  percentText(*most) +
                  "; a face may be turned over (--flip), or part of a surface lies inside a solid");
}

}  // namespace hemitex::cli
