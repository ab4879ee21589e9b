// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/free_port.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

namespace scipd::tools {

namespace asio = boost::asio;

std::uint16_t free_udp_port() {
    asio::io_context io;
    const asio::ip::udp::endpoint any{asio::ip::address_v4::loopback(), 0};
    return asio::ip::udp::socket(io, any).local_endpoint().port();
}

}  // namespace scipd::tools
