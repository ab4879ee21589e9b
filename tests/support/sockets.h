// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#pragma once

namespace scipd::tests {

/// A TCP listener on a free port of 127.0.0.1. Throws std::system_error.
int listen_on_loopback();

/// The port that a socket is bound to.
int port_of(int socket);

}  // namespace scipd::tests
