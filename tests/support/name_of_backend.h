// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a backend is, told by its type: a backend does not know what the registry calls it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>

#include "sim/backends/registry.h"

namespace scipd::sim {

/// Empty where no backend that this machine can make is of its type.
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
