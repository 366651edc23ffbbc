#include "cli/common/shell_quote.h"

#include <boost/algorithm/string.hpp>

namespace hemitex::cli {

std::string shellQuoted(const std::string& text) { return '\'' + boost::replace_all_copy(text, "'", "'\\''") + '\''; }

}  // namespace hemitex::cli
