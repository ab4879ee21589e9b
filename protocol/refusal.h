// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The status that a request gets instead of being carried out, as far as the request and the state
// of the device tell. Each handler refuses wrong parameters of its own.
#pragma once

#include <optional>

#include "protocol/device_profile.h"
#include "protocol/request.h"
#include "protocol/state.h"
#include "protocol/status.h"

namespace scipd::protocol {

/// What kind of link a request came by.
enum class LinkKind {
    network,
    tty,
};

/// Nothing: the request is to be carried out.
[[nodiscard]] std::optional<Status> refusal_of(const Request& request, State state, Trouble trouble,
                                               LinkKind link, const DeviceProfile& profile);

}  // namespace scipd::protocol
