// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a request gets instead of being carried out. Only what can be told from the request and the
// state; each operation refuses its own parameters.
#pragma once

#include <optional>

#include "protocol/command_table.h"
#include "protocol/device_profile.h"
#include "protocol/device_state.h"
#include "protocol/request.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// What kind of link a request came by.
enum class LinkKind {
    network,
    tty,
};

/// Nothing: it is to be carried out.
[[nodiscard]] std::optional<Status> refusal_of(const Request& request, State state, Trouble trouble,
                                               LinkKind link, const DeviceProfile& profile);

}  // namespace scipd::protocol
