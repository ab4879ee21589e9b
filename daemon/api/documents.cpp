// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/documents.h"

#include <chrono>
#include <cmath>
#include <utility>

namespace scipd::daemon {

double seconds(sim::Time time) {
    return std::chrono::duration<double>(time).count();
}

double rounded(double value) {
    constexpr double per_unit = 1e6;
    return std::round(value * per_unit) / per_unit;
}

Json pose_document(const sim::Pose& pose) {
    const auto& [xyz_m, q] = pose;
    return {{"xyz", {xyz_m.x, xyz_m.y, xyz_m.z}}, {"q", {q.x, q.y, q.z, q.w}}};
}

std::string text_of(const Json& document) {
    return document.dump(-1, ' ', true, Json::error_handler_t::replace);
}

HttpResponse ok(const Json& document, int status) {
    return ok_text(text_of(document), status);
}

HttpResponse ok_text(std::string document, int status) {
    HttpResponse response;
    response.status = status;
    response.body = std::move(document);
    response.body += '\n';
    return response;
}

HttpResponse no_content() {
    return {.status = 204, .content_type = {}, .body = {}, .allow = {}};
}

}  // namespace scipd::daemon
