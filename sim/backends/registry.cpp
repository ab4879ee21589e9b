// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/registry.h"

#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/backends/depth.h"
#include "sim/backends/embree.h"
#include "sim/backends/reference.h"

namespace scipd::sim {
namespace {

using Make = std::unique_ptr<RangeBackend> (*)(SharedScene);

/// In the order of backends().
constexpr std::array<Make, 3> makers{
    make_embree_backend, [](SharedScene scene) { return make_depth_backend(std::move(scene)); },
    make_reference_backend};

std::string unknown(std::string_view name) {
    std::string text = "no backend '" + std::string(name) + "': choose auto";
    for (const BackendInfo& backend : backends())
        text += ", " + std::string(backend.name);
    return text;
}

}  // namespace

std::span<const BackendInfo> backends() {
    static const std::array<BackendInfo, makers.size()> all{{
        {"embree", embree_description()},
        {"depth", depth_description()},
        {"reference", reference_description()},
    }};
    return all;
}

std::unique_ptr<RangeBackend> make_backend(std::string_view name, SharedScene scene) {
    if (name == "auto") name = backends().front().name;
    for (std::size_t i = 0; i < makers.size(); ++i) {
        if (backends()[i].name == name) return makers[i](std::move(scene));
    }
    throw std::invalid_argument(unknown(name));
}

}  // namespace scipd::sim
