/// The module hemitex_mpi, which is the only code that links MPI. Programs open it when they run with several ranks, so
/// that others start without MPI's libraries.
#pragma once

#include <memory>

#include "radiosity/ranks/messenger.h"

namespace hemitex::radiosity {

/// What the module exports under the name `hemitexMpiFunctions`.
struct MpiFunctions {
  /// Starts MPI. The destructor of the result ends it; all ranks must reach that. At most one result per process.
  std::unique_ptr<Messenger> (*start)();
};

/// Opens the module and starts MPI. Throws InputError where hemitex was built without MPI or its libraries are missing.
std::unique_ptr<Messenger> startMpi();

}  // namespace hemitex::radiosity
