// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/http/problem.h"

#include <nlohmann/json.hpp>

namespace scipd::daemon {

std::string_view http_title(int status) {
    switch (status) {
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 409:
            return "Conflict";
        case 413:
            return "Payload Too Large";
        case 415:
            return "Unsupported Media Type";
        case 426:
            return "Upgrade Required";
        case 429:
            return "Too Many Requests";
        case 431:
            return "Request Header Fields Too Large";
        case 500:
            return "Internal Server Error";
        case 501:
            return "Not Implemented";
        case 503:
            return "Service Unavailable";
        default:
            return "Error";
    }
}

HttpResponse problem(int status, std::string_view detail, std::string_view field,
                     const std::vector<std::string>& errors) {
    nlohmann::ordered_json document{{"type", "about:blank"},
                                    {"title", http_title(status)},
                                    {"status", status},
                                    {"detail", detail}};
    if (!field.empty()) document["field"] = field;
    if (!errors.empty()) document["errors"] = errors;
    // Whatever bytes a sentence quotes, the document is JSON.
    return {.status = status,
            .content_type = "application/problem+json",
            .body = document.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace),
            .allow = {}};
}

}  // namespace scipd::daemon
