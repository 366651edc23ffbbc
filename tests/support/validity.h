/// Whether a value that a test changes stays valid.
#pragma once

#include <functional>

#include "raster/base/input_error.h"

namespace hemitex::tests {

/// Whether validate() accepts a value after a change.
template <typename Value>
bool isValidAfter(const std::function<void(Value&)>& change, Value value) {
  change(value);
  try {
    validate(value);
    return true;
  } catch (const raster::InputError&) {
    return false;
  }
}

}  // namespace hemitex::tests
