/// Messages about arguments that a program does not know, with similar names.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace hemitex::cli {

/// After a failed parse of `arguments`: says which of them is the first unknown one, and which options or
/// commands have similar names. Empty if all arguments are known.
std::string unknownArgument(const CLI::App& program, const std::vector<std::string>& arguments);

}  // namespace hemitex::cli
