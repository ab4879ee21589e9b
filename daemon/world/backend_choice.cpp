// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/backend_choice.h"

#include <algorithm>
#include <utility>

#include "sim/backends/registry.h"

namespace scipd::daemon {

SharedChoice unmeasured_choice(std::string why) {
    const std::string_view preferred = sim::preferred_backend().name;
    return std::make_shared<const BackendChoice>(
        BackendChoice{std::string(preferred), std::move(why), {}});
}

std::string advice_instead_of(const sim::BackendRow& backend) {
    if (backend.draws) return "; use auto or " + std::string(sim::preferred_backend().name);
    const auto slow = std::ranges::find_if(sim::backends(), &sim::BackendRow::slow);
    if (backend.slow || slow == sim::backends().end()) return "";
    return "; give scipd more memory, or use " + std::string(slow->name) + ", which is slow";
}

}  // namespace scipd::daemon
