// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The name under which the registry knows a backend, found by its type. A backend does not know it
// itself.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>

#include "sim/backends/registry.h"

namespace scipd::sim {

/// Empty if the registry can make no backend of this type on this machine.
inline std::string name_of(const RangeBackend& backend) {
    for (const BackendRow& row : backends()) {
        try {
            const auto made = row.make(std::make_shared<const Scene>(), {});
            const RangeBackend& same = *made;
            if (typeid(same) == typeid(backend)) return std::string(row.name);
        } catch (const std::runtime_error&) {
            continue;  // not on this machine
        }
    }
    return {};
}

}  // namespace scipd::sim
