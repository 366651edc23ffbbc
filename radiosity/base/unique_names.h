/// Makes names unique, in linear time also where one name occurs many times.
#pragma once

#include <string>
#include <unordered_map>

namespace hemitex::radiosity {

class UniqueNames {
 public:
  /// Takes a name that may be taken already.
  void take(const std::string& name) { lastNumber_.try_emplace(name, 1); }

  /// Takes and returns `wanted`, or the first of `wanted~2`, `wanted~3`, ... that is not taken.
  std::string add(const std::string& wanted) {
    const auto [known, isNew] = lastNumber_.try_emplace(wanted, 1);
    if (isNew) return wanted;
    int& number = known->second;  // stays where it is when others are inserted
    std::string name;
    do name = wanted + "~" + std::to_string(++number);
    while (!lastNumber_.try_emplace(name, 1).second);
    return name;
  }

 private:
  /// The taken names, each with the number of the last name that was made of it.
  std::unordered_map<std::string, int> lastNumber_;
};

}  // namespace hemitex::radiosity
