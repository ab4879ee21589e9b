// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Walks through a YAML document and collects what is wrong with it instead of stopping at the first
// fault. Knows maps, lines and key paths, not what a configuration means. One thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <yaml-cpp/yaml.h>

#include "sim/expected.h"

namespace scipd::daemon {

/// A value and where it stands. The line is that of the key, since the value of an alias stands
/// elsewhere.
struct Field {
    std::string key;
    std::string path;  ///< "robots.rescue.pose"
    int line = 1;
    YAML::Node value;
};

/// "FILE:LINE: KEY.PATH: sentence" each. Throws ConfigError where there are too many to be of use,
/// which also bounds the work that a hostile file can cause.
class Faults {
  public:
    explicit Faults(std::string file) : file_(std::move(file)) {}

    void add(const Field& field, std::string_view sentence) {
        add(field.line, field.path, sentence);
    }
    void add(int line, std::string_view path, std::string_view sentence);

    /// What is wrong becomes a fault of the field.
    void require(const Field& field, const sim::Expected<>& checked) {
        if (!checked) add(field, checked.error().why);
    }
    /// Puts a good value into the target; a refusal becomes a fault of the field.
    template <class Value, class Target>
    void take(const Field& field, sim::Expected<Value> value, Target& target) {
        if (value) {
            target = *std::move(value);
        } else {
            add(field, value.error().why);
        }
    }

    /// What looks wrong and is taken as it is.
    void warn(const Field& field, std::string_view sentence) {
        warnings_.push_back(place(field.line, field.path) + std::string(sentence));
    }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

    /// "FILE:LINE: KEY.PATH: "
    [[nodiscard]] std::string place(int line, std::string_view path) const;

    [[nodiscard]] std::size_t count() const { return found_.size(); }

    /// The one that was found first, without file and line: for what is no file.
    [[nodiscard]] std::optional<sim::Fault> first() const;

    /// Throws ConfigError, ordered by line, if there is any.
    void throw_if_any() const;

  private:
    struct Found {
        int line;
        sim::Fault fault;
    };

    std::string file_;
    std::vector<Found> found_;
    std::vector<std::string> warnings_;
};

/// Reads the one YAML document that a configuration is; no text at all is an empty map. A second
/// document is a fault. Throws ConfigError where the text is no YAML.
YAML::Node parse_document(const std::string& text, Faults& faults);

/// The entries of a map, in the order of the file. A value that is no map is a fault, and so is a
/// key that is no plain name or stands there twice.
std::vector<Field> entries(const Field& map, Faults& faults);

/// One entry of a map, whatever the others are; nothing where it is not there.
std::optional<Field> entry_of(const Field& map, std::string_view key);

/// The words with commas between them.
std::string listed(std::span<const std::string_view> words);

/// The text of a single value, which is no map and no list.
sim::Expected<std::string> text_of(const YAML::Node& value);

/// The numbers of a list; where there are not so many, `advice` is the fault.
using ParseNumber = sim::Expected<double> (*)(std::string_view text);
sim::Expected<std::vector<double>> numbers_of(const YAML::Node& value, std::size_t count,
                                              ParseNumber parse, const std::string& advice);

/// A map with known keys.
class Section {
  public:
    /// Keys that are not known become faults.
    Section(const Field& map, std::span<const std::string_view> known, Faults& faults);

    /// Null where the key is not there.
    [[nodiscard]] const Field* find(std::string_view key) const;

    /// target = parse(text), if the key is there and parse() answers with a value.
    template <class Target, class Parse>
    void read(std::string_view key, Target& target, Parse parse) const {
        if (const Field* field = find(key))
            faults_.take(*field, text_of(field->value).and_then(parse), target);
    }
    /// Reads a text; any is right.
    void read(std::string_view key, std::string& target) const {
        if (const Field* field = find(key)) faults_.take(*field, text_of(field->value), target);
    }

    /// Reads a list of three numbers, or of two.
    void read_vector(std::string_view key, glm::dvec3& target, ParseNumber parse) const;
    void read_pair(std::string_view key, std::array<double, 2>& target, ParseNumber parse) const;

  private:
    Faults& faults_;
    std::vector<Field> fields_;
};

}  // namespace scipd::daemon
