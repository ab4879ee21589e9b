// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Descriptors from the kernel on their way to who owns them. Any thread; nothing shared.
#pragma once

#include <cerrno>
#include <string>
#include <system_error>

#include <boost/asio/posix/stream_descriptor.hpp>
#include <unistd.h>

namespace scipd::daemon {

/// The result of a system call. Throws std::system_error with `what` failed.
inline int checked(int result, const std::string& what) {
    if (result < 0) throw std::system_error(errno, std::generic_category(), what);
    return result;
}

/// Closed with `owner`, and at once where that cannot take it. Throws as checked().
inline void give(boost::asio::posix::stream_descriptor& owner, int descriptor,
                 const std::string& what) {
    checked(descriptor, what);
    boost::system::error_code error;
    owner.assign(descriptor, error);
    if (!error) return;
    ::close(descriptor);
    throw std::system_error(error, what);
}

}  // namespace scipd::daemon
