// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a pose line: the result is a usable pose or a refusal that can be shown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "sim/loaders/poses/pose_line.h"
#include "sim/text/quote.h"

namespace {

void require(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "does not hold: " << what << '\n';
    std::abort();
}

void check(const scipd::sim::PoseLine& line) {
    require(line.robot.empty() || line.model.empty(), "either a robot or a model");
    const auto& p = line.pose.translation_m;
    require(std::abs(p.x) <= 1e7 && std::abs(p.y) <= 1e7 && std::abs(p.z) <= 1e7, "within 1e7 m");
    require(std::abs(glm::length(line.pose.rotation) - 1.0) < 1e-9, "a unit quaternion");
    if (line.velocity) {
        for (const auto& rate : {line.velocity->linear_mps, line.velocity->angular_radps}) {
            require(std::abs(rate.x) <= 1e6 && std::abs(rate.y) <= 1e6 && std::abs(rate.z) <= 1e6,
                    "no faster than 1e6");
        }
    }
    if (!line.time) return;
    require(std::chrono::abs(*line.time) <= std::chrono::seconds{9'000'000'001}, "a sane time");
}

void check(std::string_view refusal) {
    require(!refusal.empty(), "a refusal has a reason");
    require(refusal.size() < 400, "a refusal is a sentence");
    require(scipd::sim::printable(refusal, refusal.size()) == refusal, "a refusal is printable");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view line{reinterpret_cast<const char*>(data), size};
    const auto parsed = scipd::sim::parse_pose_line(line);
    if (parsed) {
        check(*parsed);
    } else {
        check(parsed.error().why);
    }
    return 0;
}
