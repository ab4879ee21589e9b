// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// For those who watch over a daemon: what it has counted, and that it is there.
#include "daemon/api/documents.h"
#include "daemon/api/metrics_text.h"
#include "daemon/api/route_handlers.h"

namespace scipd::daemon {

void get_metrics(Call&& call) {
    call.respond({.content_type = "text/plain; version=0.0.4; charset=utf-8",
                  .body = metrics_text(call.api.report())});
}

// Requests that come while the daemon starts wait until everything listens, so that whoever gets an
// answer gets this one.
void get_health(Call&& call) {
    call.respond(ok({{"ready", true}, {"alive", true}}));
}

}  // namespace scipd::daemon
