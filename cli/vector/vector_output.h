/// Output that `vector export` and `vector render` share.
#pragma once

#include "cli/common/options.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::cli {

/// Prints the names, sizes and hashes of the faces.
void printFaces(const reference::TestVector& vector, const Context& context);

/// Adds `--stages`.
void addStages(Command command, bool& stages);

}  // namespace hemitex::cli
