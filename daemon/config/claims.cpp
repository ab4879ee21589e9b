// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/claims.h"

namespace scipd::daemon {

void Claims::claim(const Field* field, const std::string& what) {
    if (!field) return;
    const auto [owner, is_new] = owner_of_.emplace(what, field->path);
    if (!is_new) faults_.add(*field, what + " is taken by " + owner->second + "; use another");
}

void Claims::claim(const Field* field, const std::optional<Address>& address) {
    if (!address || address->port == 0) return;
    claim(field, text_of(*address));
}

}  // namespace scipd::daemon
