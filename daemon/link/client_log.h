// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tells the log who comes to a scanner and leaves it, and why. Lives on the shard of the scanner.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "daemon/limits/throttle.h"
#include "daemon/link/client_watch.h"
#include "daemon/link/port.h"

namespace scipd::daemon {

class ClientLog : public ClientWatch {
  public:
    /// `scanner` is what the log calls it.
    ClientLog(std::string scanner, std::vector<std::shared_ptr<Port>> ports);
    ClientLog(const ClientLog&) = delete;
    ClientLog& operator=(const ClientLog&) = delete;
    ~ClientLog() override;

    void came(const std::string& from) override;
    void left(Leaving why) override;

  private:
    void tell(Throttle& throttle, const std::string& what);

    std::string scanner_;
    std::vector<std::shared_ptr<Port>> ports_;
    Throttle comings_;
    Throttle leavings_;
};

}  // namespace scipd::daemon
