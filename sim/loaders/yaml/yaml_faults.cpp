// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/yaml/yaml_faults.h"

#include <algorithm>
#include <utility>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::size_t most_faults = 100;
constexpr std::size_t longest_sentence = 1000;

}  // namespace

std::string YamlFaults::place(int line, std::string_view path) const {
    std::string place = file_ + ":" + std::to_string(line) + ": ";
    if (!path.empty()) place.append(path).append(": ");
    return place;
}

void YamlFaults::add(int line, std::string_view path, std::string_view sentence) {
    // Sentences may hold what a library quotes as it is: a fault stays one line that can be shown.
    found_.push_back({line, {std::string(path), printable(sentence, longest_sentence)}});
    if (found_.size() < most_faults) return;
    found_.push_back({line, {{}, "too many faults; there may be more from here on"}});
    throw_if_any();
}

std::optional<Fault> YamlFaults::first() const {
    return found_.empty() ? std::nullopt : std::optional(found_.front().fault);
}

void YamlFaults::throw_if_any() const {
    if (found_.empty()) return;
    auto ordered = found_;
    std::ranges::stable_sort(ordered, {}, &Found::line);
    std::vector<std::string> faults;
    for (const auto& [line, fault] : ordered)
        faults.push_back(place(line, fault.field) + fault.why);
    throw LoadError(std::move(faults));
}

}  // namespace scipd::sim
