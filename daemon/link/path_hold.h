// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Holds a path for one scipd, as long as that one lives. Another scipd is refused the path;
// whatever the holder finds there was left behind by a scipd that was killed. The kernel knows who
// holds the path, by a socket that is no file (unix(7): abstract): so nothing is left behind, and
// spellings of the path do not matter. Other programs know nothing of this. Lives on the I/O
// thread.
#pragma once

#include <filesystem>
#include <stdexcept>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/local/stream_protocol.hpp>

namespace scipd::daemon {

/// Somebody else uses the path. The message says who, where that can be told, and what to do.
class PathHeld : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class PathHold {
  public:
    /// The folder must exist, the file need not. Throws PathHeld, or std::system_error where the
    /// kernel does not say who holds it.
    PathHold(const boost::asio::any_io_executor& executor, const std::filesystem::path& path);

  private:
    boost::asio::local::stream_protocol::acceptor socket_;
};

}  // namespace scipd::daemon
