// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/load_error.h"

#include <utility>

namespace scipd::sim {
namespace {

std::string one_a_line(const std::vector<std::string>& faults) {
    std::string text;
    for (const auto& fault : faults) {
        if (!text.empty()) text += '\n';
        text += fault;
    }
    return text;
}

}  // namespace

LoadError::LoadError(std::vector<std::string> faults)
    : std::runtime_error(one_a_line(faults)), faults_(std::move(faults)) {}

}  // namespace scipd::sim
