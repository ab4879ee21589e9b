// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/fleet/identity.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>

#include <unistd.h>

namespace scipd::daemon {

std::string host_name() {
    std::array<char, 65> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
    return name.data();
}

std::string usual_name() {
    return host_name() + "-" + std::to_string(::getpid());
}

std::string new_instance() {
    std::random_device chance;
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x%08x", chance(), chance());
    return digits.data();
}

}  // namespace scipd::daemon
