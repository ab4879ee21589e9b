// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/check/finding.h"

#include <utility>

namespace scipd::tools::checks {

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "fail";
        case Verdict::differs:
            return "differs";
        case Verdict::not_applicable:
            return "not applicable";
    }
    return "";
}

Finding pass() {
    return {};
}

Finding fail(std::string why) {
    return {Verdict::fail, std::move(why), ""};
}

Finding not_applicable(std::string why) {
    return {Verdict::not_applicable, std::move(why), ""};
}

Finding require(bool good, std::string why) {
    return good ? pass() : fail(std::move(why));
}

}  // namespace scipd::tools::checks
