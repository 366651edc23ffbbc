/// What has a limit, and the very message that a user gets beyond it.
#pragma once

#include <string>
#include <vector>

namespace hemitex::accuracy {

struct LimitCase {
  std::string name;
  std::string limit;
  bool isError;         ///< else a warning, and the work goes on
  std::string message;  ///< as the program prints it
};

std::vector<LimitCase> limitCases();

}  // namespace hemitex::accuracy
