// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Walks through a YAML document and collects what is wrong with it instead of stopping at the first
// fault. Knows maps, lines and key paths, not what a configuration means. One thread at a time.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>
#include <yaml-cpp/yaml.h>

namespace scipd::daemon {

/// A value and where it stands. The line is its key's: that of an alias's value is elsewhere.
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

    /// Calls read(); what it throws as std::invalid_argument is a fault of the field.
    template <class Read>
    void guard(const Field& field, Read read) {
        try {
            read();
        } catch (const std::invalid_argument& refusal) {
            add(field, refusal.what());
        }
    }

    /// "FILE:LINE: KEY.PATH: "
    [[nodiscard]] std::string place(int line, std::string_view path) const;

    [[nodiscard]] std::size_t count() const { return by_line_.size(); }

    /// Throws ConfigError, ordered by line, if there is any.
    void throw_if_any() const;

  private:
    std::string file_;
    std::vector<std::pair<int, std::string>> by_line_;
};

/// What a map holds, in the order of the file; what is no map, no key, or there twice is a fault.
std::vector<Field> entries(const Field& map, Faults& faults);

/// The text of a single value. Throws std::invalid_argument where it is none.
std::string text_of(const YAML::Node& value);

/// A map with known keys.
class Section {
  public:
    struct Keys {
        std::span<const std::string_view> known;
        std::span<const std::string_view> later;  ///< of versions to come
    };

    /// Keys that are not known become faults.
    Section(const Field& map, const Keys& keys, Faults& faults);

    /// Null where the key is not there.
    [[nodiscard]] const Field* find(std::string_view key) const;

    /// target = parse(text), if the key is there.
    template <class Target, class Parse>
    void read(std::string_view key, Target& target, Parse parse) const {
        if (const Field* field = find(key)) {
            faults_.guard(*field, [&] { target = parse(text_of(field->value)); });
        }
    }

    /// The same for a list of three, and of two.
    void read_vector(std::string_view key, glm::dvec3& target,
                     double (*parse)(std::string_view text)) const;
    void read_pair(std::string_view key, std::array<double, 2>& target,
                   double (*parse)(std::string_view text)) const;

  private:
    Faults& faults_;
    std::vector<Field> fields_;
};

}  // namespace scipd::daemon
