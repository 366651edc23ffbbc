#include "cli/common/shell_quote.h"

namespace hemitex::cli {

std::string shellQuoted(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return result + '\'';
}

}  // namespace hemitex::cli
