// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/connected_scanner.h"

#include <utility>

namespace scipd::tools {

ConnectedScanner::ConnectedScanner(const Target& target, const OpenOptions& open_options,
                                   protocol::client::Patience patience,
                                   TappedTransport::Listener listener)
    : transport_(open_target(target, open_options)),
      tap_(*transport_, std::move(listener)),
      driver_(tap_, patience) {
    driver_.connect();
    parameters_ = driver_.parameters();
    version_ = driver_.version();
}

std::string ConnectedScanner::model() const {
    return parameters_.model.substr(0, parameters_.model.find('('));
}

}  // namespace scipd::tools
