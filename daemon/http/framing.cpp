// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/framing.h"

#include <algorithm>
#include <string>

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/field.hpp>

#include "daemon/http/problem.h"

namespace scipd::daemon {

namespace http = boost::beast::http;

// The parser refuses Transfer-Encoding: chunked beside Content-Length by itself.
std::optional<HttpResponse> framing_fault(const http::request_header<>& request) {
    constexpr auto name = http::field::transfer_encoding;
    const auto encodings = request.count(name);
    if (encodings == 0) return std::nullopt;
    if (encodings == 1 && boost::beast::iequals(request[name], "chunked") &&
        request.version() >= 11) {
        return std::nullopt;
    }
    return problem(501, "Transfer-Encoding must be chunked and nothing else, in HTTP/1.1",
                   "Transfer-Encoding");
}

void to_origin_form(http::request_header<>& request) {
    const std::string scheme = "http://";
    const std::string target(request.target());
    const bool is_absolute = boost::beast::iequals(target.substr(0, scheme.size()), scheme);
    if (!is_absolute || request.count(http::field::host) != 1) return;
    const auto end = std::min(target.find_first_of("/?", scheme.size()), target.size());
    request.set(http::field::host, target.substr(scheme.size(), end - scheme.size()));
    const std::string rest = target.substr(end);
    request.target(rest.starts_with('/') ? rest : "/" + rest);
}

}  // namespace scipd::daemon
