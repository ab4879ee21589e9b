// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Who may come in by TCP. Every web page that a browser on this machine shows can send requests to
// 127.0.0.1, and a page whose name was made to mean 127.0.0.1 could read the answers, too. So the
// gate looks at each request before its body is read. Not for Unix sockets, which no browser
// reaches. A value; any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/beast/http/message.hpp>

#include "daemon/config/address.h"
#include "daemon/http/http_message.h"

namespace scipd::daemon {

class Gate {
  public:
    using Header = boost::beast::http::request_header<>;

    /// Whether everybody may read what lies at a path.
    using IsPublic = bool (*)(std::string_view path);

    /// Clients must know the token, unless it is empty or they ask for what is public.
    explicit Gate(std::string token = {}, IsPublic is_public = nullptr)
        : token_(std::move(token)), is_public_(is_public) {}

    /// Nothing: the request may come in. Otherwise it is answered with this and not heard: a
    /// refusal, or what a browser asks for before a request. `here` is where the client has
    /// connected to.
    [[nodiscard]] std::optional<HttpResponse> answer(const Header& request, bool has_body,
                                                     const Address& here) const;

  private:
    [[nodiscard]] bool needs_token(const Header& request) const;

    std::string token_;
    IsPublic is_public_;
};

/// The subprotocol that a WebSocket of scipd has where its client offers it. A page in a browser
/// can say the token in no other way than beside it, as the subprotocol `bearer.TOKEN`. There it
/// may be percent-encoded: browsers offer none with `/` or `=`, and a comma would end it.
inline constexpr const char* own_subprotocol = "scipd";

/// The subprotocols that a request for a WebSocket offers.
std::vector<std::string_view> subprotocols(const Gate::Header& request);

/// How clients write this address as a Host: with a port, and without where that is 80. A loopback
/// address has all the names of loopback.
std::vector<std::string> hosts_of(const Address& here);

}  // namespace scipd::daemon
