// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What two parts of one configuration cannot share: addresses, ttys, standard input. The first to
// ask keeps it; the second is a fault. One thread at a time.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "daemon/config/config.h"
#include "daemon/config/section.h"

namespace scipd::daemon {

class Claims {
  public:
    explicit Claims(Faults& faults) : faults_(faults) {}

    /// `field` wants it; null claims nothing.
    void claim(const Field* field, const std::string& what);
    /// A port that the system chooses is nobody else's.
    void claim(const Field* field, const std::optional<Address>& address);

  private:
    Faults& faults_;
    std::map<std::string, std::string> owner_of_;
};

}  // namespace scipd::daemon
