// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The live page. On the I/O thread.
#include "daemon/api/route_handlers.h"
#include "daemon/web/live_page.h"

namespace scipd::daemon {

void get_page(Call&& call) {
    call.respond(page_file("index.html", call.request));
}

// Browsers ask for it wherever they are.
void get_icon(Call&& call) {
    call.respond(page_file("icon.svg", call.request));
}

void get_page_file(Call&& call) {
    call.respond(page_file(call.names.front(), call.request));
}

}  // namespace scipd::daemon
