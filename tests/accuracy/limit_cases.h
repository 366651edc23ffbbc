/// Limits, and the messages that users get beyond them.
#pragma once

#include <string>
#include <vector>

namespace hemitex::accuracy {

struct LimitCase {
  std::string name;
  std::string limit;
  bool isError;         ///< otherwise a warning, and the program continues
  std::string message;  ///< as the program prints it
};

std::vector<LimitCase> limitCases();

}  // namespace hemitex::accuracy
