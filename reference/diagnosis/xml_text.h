/// Text inside XML, as elements and as attributes hold it.
#pragma once

#include <string>

namespace hemitex::reference {

/// With & < > and " escaped, and a space for each control character, for which XML 1.0 has no way.
std::string xmlText(const std::string& text);

}  // namespace hemitex::reference
