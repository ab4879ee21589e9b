// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A map of a YAML document whose keys are known: each is read into its target, and what is wrong
// becomes a fault. One thread at a time.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "sim/loaders/yaml/yaml_document.h"

namespace scipd::sim {

/// A map with known keys.
class YamlSection {
  public:
    /// Keys that are not known become faults. A value that is no map gets the example as advice,
    /// or without one the known keys.
    YamlSection(const YamlField& map, std::span<const std::string_view> known, YamlFaults& faults,
                std::string_view example = {});

    /// Null where the key is not there.
    [[nodiscard]] const YamlField* find(std::string_view key) const;

    /// target = parse(text), if the key is there and parse() answers with a value.
    template <class Target, class Parse>
    void read(std::string_view key, Target& target, Parse parse) const {
        if (const YamlField* field = find(key))
            faults_.take(*field, text_of(field->value).and_then(parse), target);
    }
    /// Reads a text; any is right.
    void read(std::string_view key, std::string& target) const {
        if (const YamlField* field = find(key)) faults_.take(*field, text_of(field->value), target);
    }

    /// Reads a list of three numbers, or of two.
    void read_vector(std::string_view key, glm::dvec3& target, ParseNumber parse) const;
    void read_pair(std::string_view key, std::array<double, 2>& target, ParseNumber parse) const;

  private:
    YamlFaults& faults_;
    std::vector<YamlField> fields_;
};

}  // namespace scipd::sim
