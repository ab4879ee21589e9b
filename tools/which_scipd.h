// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Finds the scipd that is meant where nobody has named a control socket, among those that run. One
// thread.
#pragma once

#include <filesystem>

namespace scipd::tools {

/// The usual socket. If nobody listens there, that of the only scipd that has a socket beside it,
/// or else that of the service where this user may use it. Tells on standard error which scipd it
/// is, if several run. Throws WrongInput where that leaves it open.
std::filesystem::path socket_of_the_scipd_meant(const std::filesystem::path& usual);

}  // namespace scipd::tools
