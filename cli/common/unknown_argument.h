/// Messages about arguments that a program does not know, with similar names.
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace hemitex::cli {

/// After a failed parse: says which argument of the command line is the first unknown one, and which options or
/// commands have similar names. Empty if all arguments are known.
std::string unknownArgument(const CLI::App& program);

}  // namespace hemitex::cli
