#include "radiosity/ranks/messenger.h"

#include "radiosity/base/module_symbol.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

const MpiFunctions& mpiFunctions() try {
  return *static_cast<const MpiFunctions*>(moduleSymbol("hemitex_mpi.so", "hemitexMpiFunctions"));
} catch (const std::runtime_error& error) {
  throw raster::InputError(
      "several ranks were started, but the module for MPI cannot be opened: " + std::string(error.what()),
      "build hemitex with libopenmpi-dev installed, or start it without mpirun");
}

}  // namespace

std::unique_ptr<Messenger> startMpi() { return mpiFunctions().start(); }

}  // namespace hemitex::radiosity
