// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/plain.h"

#include <utility>

namespace scipd::daemon {

namespace http = boost::beast::http;

HttpRequest to_plain(const http::request<http::string_body>& request,
                     const std::shared_ptr<Rate>& rate) {
    const std::string target{request.target().data(), request.target().size()};
    const auto mark = target.find('?');
    // HEAD is GET without the body of the answer.
    const bool is_head = request.method() == http::verb::head;
    const std::string method{request.method_string().data(), request.method_string().size()};
    return {.method = is_head ? "GET" : method,
            .path = target.substr(0, mark),
            .query = mark == target.npos ? "" : target.substr(mark + 1),
            .body = request.body(),
            .if_none_match = std::string(request[http::field::if_none_match]),
            .withdrawn = {},
            .rate = rate};
}

http::response<http::string_body> to_beast(HttpResponse plain, bool keep_alive) {
    http::response<http::string_body> response;
    response.version(11);
    response.result(static_cast<unsigned>(plain.status));
    if (!plain.content_type.empty()) response.set(http::field::content_type, plain.content_type);
    if (!plain.allow.empty()) response.set(http::field::allow, plain.allow);
    if (plain.status == 426) response.set(http::field::upgrade, "websocket");
    for (const auto& [name, value] : plain.headers)
        response.set(name, value);
    if (!plain.body.empty()) response.set("X-Content-Type-Options", "nosniff");
    response.body() = std::move(plain.body);
    response.keep_alive(keep_alive);
    // A 204 has no length, not even 0 (RFC 9110, 8.6), and that of a 304 would be the file's.
    if (plain.status != 204 && plain.status != 304) response.prepare_payload();
    return response;
}

}  // namespace scipd::daemon
