// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A connected scanner, and what it reports about itself. One thread.
#pragma once

#include <memory>

#include "protocol/client/device_info.h"
#include "protocol/client/driver.h"
#include "tools/scip_transport.h"
#include "tools/tapped_transport.h"
#include "tools/target.h"

namespace scipd::tools {

class ConnectedScanner {
  public:
    /// Connects; whoever listens hears that, too. Throws protocol::client::Error.
    ConnectedScanner(const Target& target, const OpenOptions& open_options,
                     protocol::client::Patience patience, TappedTransport::Listener listener = {});

    [[nodiscard]] protocol::client::Driver& driver() { return driver_; }
    [[nodiscard]] ScipTransport& transport() { return *transport_; }
    [[nodiscard]] const protocol::client::Version& version() const { return version_; }
    [[nodiscard]] const protocol::client::Parameters& parameters() const { return parameters_; }
    /// MODL without the maker's name that some models append: "URG-04LX(Hokuyo Automatic
    /// Co.,Ltd.)".
    [[nodiscard]] std::string model() const;

  private:
    std::unique_ptr<ScipTransport> transport_;
    TappedTransport tap_;
    protocol::client::Driver driver_;
    protocol::client::Parameters parameters_;
    protocol::client::Version version_;
};

}  // namespace scipd::tools
