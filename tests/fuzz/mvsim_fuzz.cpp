// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a world of MVSim, which may include itself: the result is elements whose walls and
// grounds rays can hit, or sentences that can be shown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/mvsim/mvsim_ground.h"
#include "sim/loaders/mvsim/mvsim_walk.h"
#include "sim/text/quote.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

void check_sentence(const std::string& sentence) {
    require(!sentence.empty() && sentence.size() < 1000);
    require(scipd::sim::printable(sentence, sentence.size()) == sentence);
}

void check(const std::vector<PlacedBox>& boxes) {
    for (const auto& [box, pose] : boxes) {
        require(box.size_m.x > 0.0 && box.size_m.y > 0.0 && box.size_m.z > 0.0);
        require(std::abs(pose.translation_m.x) <= 1e7 && std::abs(pose.translation_m.z) <= 1e7);
    }
}

void check(const PlacedMesh& placed) {
    require(std::abs(placed.origin_m.x) <= 1e7);
    for (const auto& vertex : placed.mesh.vertices_m)
        require(std::isfinite(vertex.x) && std::isfinite(vertex.y) && std::isfinite(vertex.z));
}

/// A PGM of two rows of three pixels.
constexpr std::string_view picture{"P5 3 2 255\n\0\200\377\0\377\0", 17};

void visit(const MvsimNode& node) {
    const std::string kind = node.name();
    if (kind == "walls") check(wall_boxes(node));
    if (kind == "element") {
        check(plane_boxes(node));
        check(grid_mesh(node, picture, 0.0, 1.0));
        check(elevation_mesh(node, picture));
    }
    (void)node.pose();
    (void)node.points();
    (void)node.number("zmax", 1.0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    int reads_left = 20;
    int visits_left = 2000;
    const MvsimVisitor visitor{
        .visit =
            [&](const MvsimNode& node) {
                if (--visits_left > 0) visit(node);
            },
        .leave_out = check_sentence,
        .read = [&](const std::filesystem::path& file) -> std::optional<std::string> {
            if (file != "self" || --reads_left < 0) return std::nullopt;
            return text;
        }};
    try {
        walk_mvsim(text, "a.world.xml", visitor);
    } catch (const LoadError& error) {
        for (const std::string& fault : error.faults())
            check_sentence(fault);
    }
    return 0;
}
