// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/http_gate.h"

#include <algorithm>
#include <cstddef>

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/verb.hpp>

#include "daemon/http/problem.h"
#include "daemon/http/url.h"

namespace scipd::daemon {
namespace {

namespace http = boost::beast::http;

using Hosts = std::vector<std::string>;

std::string_view field(const Gate::Header& request, http::field name) {
    const auto value = request[name];
    return {value.data(), value.size()};
}

bool same_letters(std::string_view a, std::string_view b) {
    return boost::beast::iequals({a.data(), a.size()}, {b.data(), b.size()});
}

bool is_one_of(std::string_view host, const Hosts& hosts) {
    return std::ranges::any_of(hosts, [&](const auto& known) { return same_letters(known, host); });
}

/// Whether a page of scipd's own has sent this.
bool is_own(std::string_view origin, const Hosts& hosts) {
    constexpr std::string_view scheme = "http://";
    return origin.starts_with(scheme) && is_one_of(origin.substr(scheme.size()), hosts);
}

HttpResponse wrong_host(const Hosts& hosts) {
    return problem(403,
                   "Host must be the address that scipd listens on, " + hosts.front() +
                       ": another name may have been made to mean this address by somebody else",
                   "Host");
}

HttpResponse wrong_origin(const Hosts& hosts) {
    return problem(403,
                   "Origin must be scipd's own, http://" + hosts.front() +
                       ": pages of others may not use the control API",
                   "Origin");
}

bool is_preflight(const Gate::Header& request) {
    return request.method() == http::verb::options &&
           request.count(http::field::access_control_request_method) != 0;
}

HttpResponse preflight_answer(std::string_view origin) {
    return {.status = 204,
            .content_type = {},
            .body = {},
            .headers = {{"Access-Control-Allow-Origin", std::string(origin)},
                        {"Access-Control-Allow-Methods", "GET, PUT, POST, DELETE"},
                        {"Access-Control-Allow-Headers", "Authorization, Content-Type"},
                        {"Vary", "Origin"}}};
}

/// Looks at all of both, so that the time it takes does not tell how much of a guess is right.
bool is_same(std::string_view said, std::string_view token) {
    unsigned differences = said.size() == token.size() ? 0 : 1;
    for (std::size_t i = 0; i < said.size(); ++i)
        differences |= static_cast<unsigned char>(said[i] ^ token[i % token.size()]);
    return differences == 0;
}

/// Whether a client says the token. One that says two does not.
bool says(const std::string& token, const Gate::Header& request) {
    constexpr std::string_view scheme = "Bearer ";
    constexpr std::string_view offer = "bearer.";
    const std::string_view said = field(request, http::field::authorization);
    if (!said.empty()) {
        return request.count(http::field::authorization) == 1 &&
               same_letters(said.substr(0, scheme.size()), scheme) &&
               is_same(said.substr(scheme.size()), token);
    }
    auto offered = subprotocols(request);
    std::erase_if(offered, [&](std::string_view text) { return !text.starts_with(offer); });
    if (offered.size() != 1) return false;
    const std::string_view as_it_is = offered.front().substr(offer.size());
    return is_same(as_it_is, token) ||
           is_same(percent_decoded(as_it_is).value_or(std::string{}), token);
}

HttpResponse unknown_client() {
    auto response = problem(401,
                            "Authorization must be `Bearer TOKEN`, with the first line of the "
                            "file that token_file under http in the configuration names",
                            "Authorization");
    response.headers = {{"WWW-Authenticate", "Bearer"}};
    return response;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view white = " \t";
    text.remove_prefix(std::min(text.find_first_not_of(white), text.size()));
    return text.substr(0, text.find_last_not_of(white) + 1);
}

bool is_json(std::string_view content_type) {
    return same_letters(trimmed(content_type.substr(0, content_type.find(';'))),
                        "application/json");
}

}  // namespace

std::vector<std::string> hosts_of(const Address& here) {
    std::vector<Address> addresses{here};
    if (is_loopback(here)) {
        for (const char* name : {"127.0.0.1", "::1", "localhost"})
            addresses.push_back({name, here.port});
    }
    Hosts hosts;
    for (const Address& address : addresses) {
        hosts.push_back(text_of(address));
        if (here.port == 80) hosts.push_back(hosts.back().substr(0, hosts.back().rfind(':')));
    }
    return hosts;
}

std::vector<std::string_view> subprotocols(const Gate::Header& request) {
    std::vector<std::string_view> offers;
    auto [field, end] = request.equal_range(http::field::sec_websocket_protocol);
    for (; field != end; ++field) {
        std::string_view rest{field->value().data(), field->value().size()};
        while (!rest.empty()) {
            const std::string_view offer = rest.substr(0, rest.find(','));
            rest.remove_prefix(std::min(offer.size() + 1, rest.size()));
            offers.push_back(trimmed(offer));
        }
    }
    return offers;
}

bool Gate::needs_token(const Header& request) const {
    if (token_.empty()) return false;
    const bool reads = request.method() == http::verb::get || request.method() == http::verb::head;
    const std::string_view target{request.target().data(), request.target().size()};
    return !(reads && is_public_ != nullptr && is_public_(target.substr(0, target.find('?'))));
}

std::optional<HttpResponse> Gate::answer(const Header& request, bool has_body,
                                         const Address& here) const {
    const Hosts hosts = hosts_of(here);
    if (request.count(http::field::host) != 1 ||
        !is_one_of(field(request, http::field::host), hosts)) {
        return wrong_host(hosts);
    }
    const auto origins = request.count(http::field::origin);
    const std::string_view origin = field(request, http::field::origin);
    if (origins > 1 || (origins == 1 && !is_own(origin, hosts))) return wrong_origin(hosts);
    if (is_preflight(request) && origins == 1) return preflight_answer(origin);
    if (needs_token(request) && !says(token_, request)) return unknown_client();
    const bool is_one_type = request.count(http::field::content_type) == 1;
    if (has_body && !(is_one_type && is_json(field(request, http::field::content_type)))) {
        return problem(415, "a body must have the Content-Type application/json", "Content-Type");
    }
    return std::nullopt;
}

}  // namespace scipd::daemon
