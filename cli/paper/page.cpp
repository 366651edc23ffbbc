#include "cli/paper/page.h"

#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"

namespace hemitex::cli {

std::string paperPage(nlohmann::ordered_json result, const std::filesystem::path& folder) {
  for (auto& figure : result.at("figures")) figure["png"] = base64OfFile(folder / figure.at("file").get<std::string>());
  return completePage(paperPageText, result);
}

}  // namespace hemitex::cli
