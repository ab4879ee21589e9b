// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Stands between a session and its client, so that a conversation can go wrong on purpose. Without
// one a session only looks whether there is one, once for each message. Lives on the thread of its
// session.
#pragma once

#include <optional>
#include <vector>

#include "protocol/action.h"
#include "protocol/request.h"
#include "protocol/status.h"

namespace scipd::protocol {

class Session;

class SessionHook {
  public:
    virtual ~SessionHook() = default;

    /// A request is about to be looked at. A status: it is refused with that, and not carried out.
    virtual std::optional<Status> refuse(const Request& request) = 0;
    /// These leave in the place of the message, in order.
    virtual std::vector<Send> leave(const Session& from, Send message) = 0;
    /// The client of this session is another one from here on, or there is none.
    virtual void forget(const Session& session) = 0;
};

}  // namespace scipd::protocol
