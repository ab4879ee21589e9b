// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a recording has beside scans, such as its topics of other types: told in one sentence, once
// all of it has been met. Of one owner; any thread.
#pragma once

#include <set>
#include <string>

#include "sim/text/quote.h"

namespace scipd::sim {

class LeftOut {
  public:
    /// "/tf (tf/tfMessage)". The same thing counts once.
    void add(const std::string& name, const std::string& type) {
        things_.insert(printable(name) + " (" + printable(type) + ")");
    }

    [[nodiscard]] bool empty() const { return things_.empty(); }

    /// Names the first of them.
    [[nodiscard]] std::string sentence() const {
        constexpr std::size_t most_named = 20;
        std::string names;
        std::size_t count = 0;
        for (const std::string& thing : things_) {
            if (count++ == most_named) {
                names += " and " + std::to_string(things_.size() - most_named) + " more";
                break;
            }
            names += (names.empty() ? "" : ", ") + thing;
        }
        return "left out, since no scans are read from it: " + names;
    }

  private:
    std::set<std::string> things_;
};

}  // namespace scipd::sim
