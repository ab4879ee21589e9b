// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/link/path_hold.h"

#include <cerrno>
#include <string>
#include <system_error>

#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sim/fnv1a.h"

namespace scipd::daemon {
namespace {

using Local = boost::asio::local::stream_protocol;

/// The same for every name of the folder.
Local::endpoint name_of(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0)
        throw std::system_error(errno, std::generic_category(), folder.string());
    const auto number = sim::fnv1a<std::uint64_t>(path.filename().string());
    return {std::string(1, '\0') + "scipd/" + std::to_string(status.st_dev) + "/" +
            std::to_string(status.st_ino) + "/" + std::to_string(number)};
}

/// 0 where the kernel does not say.
pid_t holder_of(const boost::asio::any_io_executor& executor, const Local::endpoint& name) {
    Local::socket asking(executor, Local());
    asking.native_non_blocking(true);
    ucred holder{};
    socklen_t size = sizeof(holder);
    const int socket = asking.native_handle();
    const bool told = ::connect(socket, name.data(), static_cast<socklen_t>(name.size())) == 0 &&
                      ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &holder, &size) == 0;
    return told ? holder.pid : 0;
}

std::string who(pid_t holder) {
    const std::string end_it = "; end that one, or choose another path";
    if (holder == 0) return "another scipd" + end_it;
    if (holder == ::getpid()) return "this scipd for something else; choose another path";
    return "another scipd, process " + std::to_string(holder) + end_it;
}

}  // namespace

PathHold::PathHold(const boost::asio::any_io_executor& executor, const std::filesystem::path& path)
    : socket_(executor, Local()) {
    const Local::endpoint name = name_of(path);
    boost::system::error_code error;
    socket_.bind(name, error);
    if (error == boost::asio::error::address_in_use) {
        throw PathHeld(path.string() + " is used by " + who(holder_of(executor, name)));
    }
    if (error) throw std::system_error(error, path.string());
    socket_.listen();
}

}  // namespace scipd::daemon
