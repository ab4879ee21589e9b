// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "protocol/scip1_words.h"

namespace scipd::protocol {
namespace {

using Kind = Scip1Request::Kind;

std::string scan_words(const StepWindow& window) {
    std::string text = "requests one scan, steps " + std::to_string(window.first) + " to " +
                       std::to_string(window.last);
    if (window.cluster > 1) text += ", one value for " + std::to_string(window.cluster) + " steps";
    return text;
}

}  // namespace

std::string scip1_request_words(const Scip1Request& request) {
    switch (request.kind) {
        case Kind::version:
            return "requests the version, in SCIP 1.1";
        case Kind::scan:
            return scan_words(request.window) + ", in SCIP 1.1";
        case Kind::laser_off:
            return "switches the laser off, in SCIP 1.1";
        case Kind::laser_on:
            return "switches the laser on, in SCIP 1.1";
        case Kind::bit_rate:
            return "sets the bit rate to " + std::to_string(request.bit_rate) + ", in SCIP 1.1";
        case Kind::choose_scip2:
            return "leaves SCIP 1.1";
        case Kind::unknown:
            break;
    }
    return {};
}

std::string_view scip1_reply_words(const Scip1Request& echo, char status) {
    if (status != scip1_status::ok) return "not carried out";
    switch (echo.kind) {
        case Kind::version:
            return "returns the version";
        case Kind::scan:
            return "the requested scan";
        case Kind::laser_off:
            return "the laser is off";
        case Kind::laser_on:
            return "the laser is on";
        case Kind::bit_rate:
            return "the bit rate changes";
        case Kind::choose_scip2:
            return "SCIP 2.0 is spoken";
        case Kind::unknown:
            break;
    }
    return "carried out";
}

std::string_view scip1_status_words(char status) {
    if (status == scip1_status::ok) return "carried out";
    if (status == scip1_status::unknown)
        return "the scanner does not know the request, or its laser is off";
    return {};
}

}  // namespace scipd::protocol
