// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/registry.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/backends/depth.h"
#include "sim/backends/depth_probe.h"
#include "sim/backends/embree.h"
#include "sim/backends/reference.h"

namespace scipd::sim {
namespace {

/// For a backend that does not draw.
template <std::unique_ptr<RangeBackend> (*Make)(SharedScene)>
std::unique_ptr<RangeBackend> without_options(SharedScene scene, const DepthOptions&) {
    return Make(std::move(scene));
}

std::string unknown(std::string_view name) {
    std::string text = "no backend '" + std::string(name) + "': choose ";
    for (const BackendRow& row : backends())
        text += (&row == &backends().front() ? "" : ", ") + std::string(row.name);
    return text;
}

}  // namespace

std::span<const BackendRow> backends() {
    static const std::array rows{
        BackendRow{.name = "embree",
                   .description = embree_description(),
                   .make = without_options<make_embree_backend>},
        BackendRow{.name = "depth",
                   .description = depth_description(),
                   .draws = true,
                   .probe = probe_depth,
                   .make = make_depth_backend},
        BackendRow{.name = "reference",
                   .description = reference_description(),
                   .slow = true,
                   .make = without_options<make_reference_backend>},
    };
    return rows;
}

const BackendRow* find_backend(std::string_view name) {
    const auto found = std::ranges::find(backends(), name, &BackendRow::name);
    return found == backends().end() ? nullptr : &*found;
}

const BackendRow& preferred_backend() {
    return backends().front();
}

const BackendRow& drawing_backend() {
    return *std::ranges::find_if(backends(), &BackendRow::draws);
}

std::unique_ptr<RangeBackend> make_backend(std::string_view name, SharedScene scene,
                                           const DepthOptions& options) {
    const BackendRow* row = find_backend(name);
    if (row == nullptr) throw std::invalid_argument(unknown(name));
    return row->make(std::move(scene), options);
}

}  // namespace scipd::sim
