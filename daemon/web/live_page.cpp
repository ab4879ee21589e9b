// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/web/live_page.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "daemon/http/problem.h"
#include "daemon/web/page_files.h"

namespace scipd::daemon {
namespace {

using Headers = std::vector<std::pair<std::string, std::string>>;

std::string type_of(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, const char*>, 4> types{{
        {".html", "text/html; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".svg", "image/svg+xml"},
    }};
    const auto* const type =
        std::ranges::find_if(types, [&](const auto& known) { return name.ends_with(known.first); });
    return type == types.end() ? "application/octet-stream" : type->second;
}

/// A page of somebody else can neither be taken in by this one, nor take it in.
Headers headers_of(const std::string& tag) {
    return {{"ETag", tag},
            {"Cache-Control", "no-cache"},
            {"X-Frame-Options", "DENY"},
            {"Referrer-Policy", "no-referrer"},
            {"Content-Security-Policy",
             "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
             "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"}};
}

}  // namespace

HttpResponse page_file(std::string_view name, const HttpRequest& request) {
    if (page_files().empty()) {
        return problem(404,
                       "this scipd was built without its page; install libjs-three, configure the "
                       "build with -DSCIPD_PAGE=ON, and build it again. The control API is here "
                       "as ever");
    }
    const auto file = std::ranges::find(page_files(), name, &PageFile::name);
    if (file == page_files().end()) {
        return problem(404, "the page has no file \"" + std::string(name) + "\"");
    }
    const std::string tag = '"' + std::string(file->hash) + '"';
    HttpResponse response{.content_type = type_of(name), .headers = headers_of(tag)};
    if (request.if_none_match.find(tag) != std::string::npos) {
        response.status = 304;
    } else {
        response.body = file->content;
    }
    return response;
}

bool is_of_page(std::string_view path) {
    return path == "/" || path == "/favicon.ico" || path.starts_with("/page/");
}

}  // namespace scipd::daemon
