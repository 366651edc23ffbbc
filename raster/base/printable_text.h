/// Text of files, command lines and devices as a terminal may show it. Raw, its control characters could move the
/// cursor, hide text, or reverse the direction in which it is read.
#pragma once

#include <string>
#include <string_view>

namespace hemitex::raster {

/// The text with `?` for each byte that is not UTF-8 and for each character that controls a terminal or the direction
/// of text: U+0000 to U+001F, U+007F to U+009F, U+061C, U+200E, U+200F, U+2028 to U+202E and U+2066 to U+2069. Those of
/// the first group that are in `kept`, such as line ends, stay.
std::string printable(std::string_view text, std::string_view kept = {});

/// JSON text with escapes, a backslash and `u009b` for one, for the characters that printable() replaces; line ends
/// between values stay. Reads back to the same values. The text must be valid UTF-8.
std::string printableJson(std::string_view json);

}  // namespace hemitex::raster
