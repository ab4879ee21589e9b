// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/which_scipd.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <system_error>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>

#include "sim/text/quote.h"
#include "tools/options.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;
using Local = boost::asio::local::stream_protocol;

bool somebody_listens(const fs::path& path) {
    boost::asio::io_context io;
    Local::socket socket(io, Local());
    // A scipd that is too busy to let anybody in is there all the same.
    socket.non_blocking(true);
    boost::system::error_code error;
    try {
        socket.connect(Local::endpoint(path.string()), error);
    } catch (const boost::system::system_error&) {
        return false;  // no socket has so long a name
    }
    return !error || error == boost::asio::error::would_block;
}

/// control.sock and those beside it, such as control-4711.sock, in order.
std::vector<fs::path> living(const fs::path& usual) {
    std::vector<fs::path> sockets;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(usual.parent_path(), error)) {
        const fs::path& path = entry.path();
        const bool beside = path.extension() == usual.extension() &&
                            path.stem().string().starts_with(usual.stem().string() + "-");
        if ((beside || path == usual) && somebody_listens(path)) sockets.push_back(path);
    }
    std::ranges::sort(sockets);
    return sockets;
}

std::string listed(const std::vector<fs::path>& sockets, const fs::path& but = {}) {
    std::string text;
    for (const fs::path& socket : sockets) {
        if (socket != but) text += (text.empty() ? "" : ", ") + socket.string();
    }
    return sim::shown(text);
}

}  // namespace

fs::path socket_of_the_scipd_meant(const fs::path& usual) {
    const std::vector<fs::path> sockets = living(usual);
    const fs::path of_service = "/run/scipd/control.sock";
    if (sockets.empty()) return somebody_listens(of_service) ? of_service : usual;
    if (sockets.size() == 1) return sockets.front();
    if (std::ranges::find(sockets, usual) == sockets.end()) {
        throw WrongInput("several scipd run; name the socket of one with --control: " +
                         listed(sockets));
    }
    const std::string note = "several scipd run; this is the one at " + sim::shown(usual.string()) +
                             ". --control names another: " + listed(sockets, usual) + "\n";
    std::fputs(note.c_str(), stderr);
    return usual;
}

}  // namespace scipd::tools
