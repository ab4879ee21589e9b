// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A YAML document: its maps, lists and single values, each with its place. What is wrong becomes a
// fault. Knows nothing of what a document means. One thread at a time.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "sim/expected.h"
#include "sim/text/quote.h"

namespace scipd::sim {

/// A value and where it stands. The line is that of the key, since the value of an alias stands
/// elsewhere.
struct YamlField {
    std::string key;
    std::string path;  ///< "robots.rescue.pose"
    int line = 1;
    YAML::Node value;
};

/// Collects what is wrong with a YAML document instead of stopping at the first fault. Knows lines
/// and key paths, not what a document means.
/// "FILE:LINE: KEY.PATH: sentence" each. Throws LoadError where there are too many to be of use,
/// which also bounds the work that a hostile file can cause.
class YamlFaults {
  public:
    explicit YamlFaults(std::string file) : file_(std::move(file)) {}

    void add(const YamlField& field, std::string_view sentence) {
        add(field.line, field.path, sentence);
    }
    void add(int line, std::string_view path, std::string_view sentence);

    /// Adds an error to the faults of the field.
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

    /// Warns of a value that looks wrong and is accepted.
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

/// Reads the one YAML document that a file is; no text at all is an empty map. A second document is
/// a fault. Throws LoadError where the text is no YAML. `what` says what it was to be: "a map".
YAML::Node parse_yaml(const std::string& text, std::string_view what, YamlFaults& faults);

/// The entries of a map, in the order of the file. A value that is no map is a fault, and so is a
/// key that is no plain name or stands there twice. `advice` ends the message about a value that is
/// no map.
std::vector<YamlField> entries(const YamlField& map, YamlFaults& faults,
                               std::string_view advice = {});

/// One entry of a map, whatever the others are; nothing where it is not there.
std::optional<YamlField> entry_of(const YamlField& map, std::string_view key);

/// The text of a single value, which is no map and no list.
Expected<std::string> text_of(const YAML::Node& value);

/// The numbers of a list; where there are not so many, `advice` is the fault.
using ParseNumber = Expected<double> (*)(std::string_view text);
Expected<std::vector<double>> numbers_of(const YAML::Node& value, std::size_t count,
                                         ParseNumber parse, const std::string& advice);

}  // namespace scipd::sim
