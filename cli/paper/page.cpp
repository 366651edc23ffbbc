#include "cli/paper/page.h"

#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"

namespace hemitex::cli {

std::string paperPage(const nlohmann::ordered_json& result, const std::filesystem::path& folder) {
  nlohmann::ordered_json pictures = nlohmann::ordered_json::object();
  for (const auto& figure : result.at("figures")) {
    const auto file = figure.at("file").get<std::string>();
    pictures[file] = base64OfFile(folder / file);
  }
  return completePage(paperPageText, result, pictures);
}

}  // namespace hemitex::cli
