/// Escapes text for XML elements and attributes.
#pragma once

#include <string>

namespace hemitex::reference {

/// The text with & < > and " escaped, and a space for each control character, which XML 1.0 cannot represent.
std::string xmlText(const std::string& text);

}  // namespace hemitex::reference
