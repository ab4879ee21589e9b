// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a world of Stage, which includes itself and a part: the result is entities whose
// blocks rays can hit, or faults that can be shown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/stage/stage_file.h"
#include "sim/loaders/stage/stage_scene.h"
#include "sim/text/quote.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check_sentence(const std::string& sentence) {
    require(!sentence.empty() && sentence.size() < 500);
    require(scipd::sim::printable(sentence, sentence.size()) == sentence);
}

void check(const Mesh& mesh) {
    for (const auto& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            require(triangle[i] < mesh.vertices_m.size());
    }
    for (const auto& vertex : mesh.vertices_m) {
        for (int axis = 0; axis < 3; ++axis)
            require(std::abs(vertex[axis]) <= 1.1e7F);
    }
}

void check(const StageEntity& entity, int& left) {
    if (--left < 0) return;
    const StageUnits units{.metres = 1.0, .radians = 1.0};
    try {
        const glm::dvec3 size_m = stage_size_m(entity, units);
        for (const Mesh& mesh : block_meshes(entity, size_m, units))
            check(mesh);
    } catch (const std::invalid_argument& wrong) {
        check_sentence(wrong.what());
    }
    for (const StageEntity& child : entity.children)
        check(child, left);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    const auto find = [&](const std::string& name, const auto&) -> std::optional<StageText> {
        if (name == "self") return StageText{"self", text};
        if (name == "part") return StageText{"part", "define part model ( size [1 1 1] )\n"};
        return std::nullopt;
    };
    try {
        const StageFile file = parse_stage({"a.world", text}, find);
        for (const std::string& warning : file.warnings)
            check_sentence(warning);
        int left = 200;
        check(file.world, left);
    } catch (const LoadError& error) {
        for (const std::string& fault : error.faults())
            check_sentence(fault);
    }
    return 0;
}
