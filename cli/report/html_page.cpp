#include "cli/report/html_page.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fstream>
#include <iterator>

#include "cli/common/json.h"
#include "cli/report/embedded_files.h"
#include "raster/base/file_io.h"

namespace hemitex::cli {
namespace {

/// Puts `by` in the place of the first `mark`, which the text has.
void fillIn(std::string& text, const std::string& mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
}

/// JSON for a script element, which the letters `</` could end.
std::string scriptText(const nlohmann::ordered_json& json) {
  std::string text = toText(json);
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos;) text.replace(at, 2, "<\\/");
  return text;
}

}  // namespace

std::string completePage(std::string page, const nlohmann::ordered_json& result) {
  fillIn(page, "{{page style}}", pageStyle);
  fillIn(page, "{{page script}}", pageScript);
  fillIn(page, "{{chart library}}", chartLibrary);
  fillIn(page, "{{result}}", scriptText(result));
  return page;
}

std::string base64OfFile(const std::filesystem::path& file) {
  using namespace boost::archive::iterators;
  const std::string bytes = raster::readFile(file);
  using Letters = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string text(Letters(bytes.begin()), Letters(bytes.end()));
  while (text.size() % 4 != 0) text += '=';
  return text;
}

}  // namespace hemitex::cli
