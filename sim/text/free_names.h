// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Gives each thing of a world a name of its own, though many are called alike: NAME, then NAME:1,
// NAME:2 and so on. Of one owner; any thread.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>

#include "sim/text/name.h"

namespace scipd::sim {

class FreeNames {
  public:
    /// What stands between name and number, and the number that comes first.
    FreeNames(char separator, int first) : separator_(separator), first_(first) {}

    /// The name, shortened where it is too long (short_name), or the first with a number that is
    /// free. A world may have tens of thousands of one name: each goes on behind the one before.
    [[nodiscard]] std::string take(const std::string& said) {
        std::string name = short_name(said);
        int& next = next_.try_emplace(said, first_).first->second;
        while (!taken_.insert(name).second)
            name = short_name(said + separator_ + std::to_string(next++));
        return name;
    }

  private:
    char separator_;
    int first_;
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, int> next_;  ///< by what was said
};

}  // namespace scipd::sim
