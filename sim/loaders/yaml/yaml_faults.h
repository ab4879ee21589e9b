// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Collects what is wrong with a YAML document instead of stopping at the first fault. Knows lines
// and key paths, not what a document means. One thread at a time.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "sim/expected.h"

namespace scipd::sim {

/// A value and where it stands. The line is that of the key, since the value of an alias stands
/// elsewhere.
struct YamlField {
    std::string key;
    std::string path;  ///< "robots.rescue.pose"
    int line = 1;
    YAML::Node value;
};

/// "FILE:LINE: KEY.PATH: sentence" each. Throws LoadError where there are too many to be of use,
/// which also bounds the work that a hostile file can cause.
class YamlFaults {
  public:
    explicit YamlFaults(std::string file) : file_(std::move(file)) {}

    void add(const YamlField& field, std::string_view sentence) {
        add(field.line, field.path, sentence);
    }
    void add(int line, std::string_view path, std::string_view sentence);

    /// What is wrong becomes a fault of the field.
    void require(const YamlField& field, const Expected<>& checked) {
        if (!checked) add(field, checked.error().why);
    }
    /// Puts a good value into the target; a refusal becomes a fault of the field.
    template <class Value, class Target>
    void take(const YamlField& field, Expected<Value> value, Target& target) {
        if (value) {
            target = *std::move(value);
        } else {
            add(field, value.error().why);
        }
    }

    /// What looks wrong and is taken as it is.
    void warn(const YamlField& field, std::string_view sentence) {
        warnings_.push_back(place(field.line, field.path) + std::string(sentence));
    }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// "FILE:LINE: KEY.PATH: "
    [[nodiscard]] std::string place(int line, std::string_view path) const;

    [[nodiscard]] std::size_t count() const { return found_.size(); }

    /// The one that was found first, without file and line: for what is no file.
    [[nodiscard]] std::optional<Fault> first() const;

    /// Throws LoadError, ordered by line, if there is any.
    void throw_if_any() const;

  private:
    struct Found {
        int line;
        Fault fault;
    };

    std::string file_;
    std::vector<Found> found_;
    std::vector<std::string> warnings_;
};

}  // namespace scipd::sim
