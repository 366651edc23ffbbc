/// A loop over standard threads, for iterations that take long or wait. For short ones see parallelFor.
#pragma once

#include <cstddef>
#include <functional>

namespace hemitex::raster {

/// Calls body(0) to body(count - 1) once each, on at most `threads` threads, one of which is the caller's. Each thread
/// takes the next number when it is ready. Where the system starts fewer threads, those that run do all calls. After
/// an exception no further call begins; it is thrown again when all threads have ended.
void forEachOnThreads(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& body);

}  // namespace hemitex::raster
