// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/yaml/yaml_section.h"

#include <algorithm>

#include "sim/text/near_word.h"

namespace scipd::sim {
namespace {

/// What somebody who misspelt a key is told.
std::string unknown_key(std::string_view key, std::span<const std::string_view> known) {
    if (const auto near = meant(key, known))
        return "unknown key; did you mean " + std::string{*near} + "?";
    return "unknown key; known here are " + listed(known);
}

}  // namespace

YamlSection::YamlSection(const YamlField& map, std::span<const std::string_view> known,
                         YamlFaults& faults, std::string_view example)
    : faults_(faults) {
    const std::string advice =
        example.empty() ? "; known here are " + listed(known) : ", such as " + std::string(example);
    for (auto& field : entries(map, faults, advice)) {
        if (std::find(known.begin(), known.end(), field.key) != known.end()) {
            fields_.push_back(std::move(field));
        } else {
            faults.add(field, unknown_key(field.key, known));
        }
    }
}

const YamlField* YamlSection::find(std::string_view key) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(),
                                    [key](const YamlField& field) { return field.key == key; });
    return found == fields_.end() ? nullptr : &*found;
}

void YamlSection::read_vector(std::string_view key, glm::dvec3& target, ParseNumber parse) const {
    const YamlField* field = find(key);
    if (!field) return;
    const std::string advice = "must be a list of three numbers, such as [1, 2, 0]";
    faults_.take(*field, numbers_of(field->value, 3, parse, advice).map([](const auto& numbers) {
        return glm::dvec3{numbers[0], numbers[1], numbers[2]};
    }),
                 target);
}

void YamlSection::read_pair(std::string_view key, std::array<double, 2>& target,
                            ParseNumber parse) const {
    const YamlField* field = find(key);
    if (!field) return;
    const std::string advice = "must be a list of two numbers, such as [1, 2]";
    faults_.take(*field, numbers_of(field->value, 2, parse, advice).map([](const auto& numbers) {
        return std::array{numbers[0], numbers[1]};
    }),
                 target);
}

}  // namespace scipd::sim
