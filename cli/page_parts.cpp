#include "cli/page_parts.h"

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fstream>
#include <iterator>

#include "cli/json.h"

namespace hemitex::cli {

void fillIn(std::string& text, const std::string& mark, const std::string& by) {
  text.replace(text.find(mark), mark.size(), by);
}

std::string scriptText(const nlohmann::ordered_json& json) {
  std::string text = toText(json);
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos;) text.replace(at, 2, "<\\/");
  return text;
}

std::string base64OfFile(const std::filesystem::path& file) {
  using namespace boost::archive::iterators;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  using Letters = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  std::string text(Letters(bytes.begin()), Letters(bytes.end()));
  while (text.size() % 4 != 0) text += '=';
  return text;
}

}  // namespace hemitex::cli
