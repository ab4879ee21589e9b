// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/machine.h"

#include <fstream>
#include <stdexcept>
#include <thread>

#include "sim/backends/depth_device.h"
#include "sim/backends/registry.h"

namespace scipd::tools {
namespace {

std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "an unknown processor";
}

std::string what_draws() {
    try {
        const auto context = sim::depth_context();
        const sim::EglDescription& it = context->description();
        return it.renderer + ", OpenGL " + it.opengl;
    } catch (const std::runtime_error&) {
        return "draws no depth buffer";
    }
}

}  // namespace

std::string why_nothing_is_drawn() {
    try {
        (void)sim::depth_context();
        return {};
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

std::string describe_machine() {
    return processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores; " +
           std::string(sim::preferred_backend().description) + "; " + what_draws();
}

}  // namespace scipd::tools
