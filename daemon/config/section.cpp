// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/section.h"

#include <algorithm>
#include <map>

#include "daemon/config/config_error.h"
#include "sim/text/near_word.h"
#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

constexpr std::size_t most_faults = 100;
constexpr std::size_t most_entries = 4096;
constexpr std::size_t longest_sentence = 1000;

/// What somebody who misspelt a key is told.
std::string unknown_key(std::string_view key, std::span<const std::string_view> known) {
    if (const auto near = sim::meant(key, known))
        return "unknown key; did you mean " + std::string{*near} + "?";
    return "unknown key; known here are " + listed(known);
}

std::string path_of(const Field& map, std::string_view key) {
    const auto shown = sim::printable(key, 64);
    return map.path.empty() ? shown : map.path + "." + shown;
}

}  // namespace

std::string Faults::place(int line, std::string_view path) const {
    std::string place = file_ + ":" + std::to_string(line) + ": ";
    if (!path.empty()) place.append(path).append(": ");
    return place;
}

void Faults::add(int line, std::string_view path, std::string_view sentence) {
    // Sentences may hold what a library quotes as it is: a fault stays one line that can be shown.
    found_.push_back({line, {std::string(path), sim::printable(sentence, longest_sentence)}});
    if (found_.size() < most_faults) return;
    found_.push_back({line, {{}, "too many faults; there may be more from here on"}});
    throw_if_any();
}

std::optional<sim::Fault> Faults::first() const {
    return found_.empty() ? std::nullopt : std::optional(found_.front().fault);
}

void Faults::throw_if_any() const {
    if (found_.empty()) return;
    auto ordered = found_;
    std::ranges::stable_sort(ordered, {}, &Found::line);
    std::vector<std::string> faults;
    for (const auto& [line, fault] : ordered)
        faults.push_back(place(line, fault.field) + fault.why);
    throw ConfigError(std::move(faults));
}

std::vector<Field> entries(const Field& map, Faults& faults) {
    if (!map.value.IsMap()) {
        faults.add(map, "must be a map of keys and values");
        return {};
    }
    if (map.value.size() > most_entries) {
        faults.add(map, "has more than 4096 entries; split it into several daemons");
        return {};
    }
    std::vector<Field> fields;
    std::map<std::string, int> line_of;
    for (const auto& entry : map.value) {
        const int line = entry.first.Mark().line + 1;
        if (!entry.first.IsScalar()) {
            faults.add(line, map.path, "a key must be a plain name");
            continue;
        }
        Field field{entry.first.Scalar(), path_of(map, entry.first.Scalar()), line, entry.second};
        const auto [first, is_new] = line_of.emplace(field.key, line);
        if (!is_new) {
            faults.add(field, "given twice, first in line " + std::to_string(first->second) +
                                  "; keep one");
            continue;
        }
        fields.push_back(std::move(field));
    }
    return fields;
}

std::optional<Field> entry_of(const Field& map, std::string_view key) {
    if (!map.value.IsMap()) return std::nullopt;
    for (const auto& entry : map.value) {
        if (!entry.first.IsScalar() || entry.first.Scalar() != key) continue;
        return Field{std::string(key), path_of(map, key), entry.first.Mark().line + 1,
                     entry.second};
    }
    return std::nullopt;
}

std::string listed(std::span<const std::string_view> words) {
    std::string text;
    for (const auto word : words)
        text += (text.empty() ? "" : ", ") + std::string{word};
    return text;
}

sim::Expected<std::string> text_of(const YAML::Node& value) {
    if (value.IsScalar()) return value.Scalar();
    if (value.IsNull()) return sim::refuse("has no value; give one or leave the key out");
    return sim::refuse(std::string{"must be a single value, not a "} +
                       (value.IsMap() ? "map" : "list"));
}

sim::Expected<std::vector<double>> numbers_of(const YAML::Node& value, std::size_t count,
                                              ParseNumber parse, const std::string& advice) {
    if (!value.IsSequence() || value.size() != count) return sim::refuse(advice);
    std::vector<double> numbers;
    for (const YAML::Node& item : value) {
        const auto number = text_of(item).and_then(parse);
        if (!number) return tl::unexpected(number.error());
        numbers.push_back(*number);
    }
    return numbers;
}

Section::Section(const Field& map, std::span<const std::string_view> known, Faults& faults)
    : faults_(faults) {
    for (auto& field : entries(map, faults)) {
        if (std::find(known.begin(), known.end(), field.key) != known.end()) {
            fields_.push_back(std::move(field));
        } else {
            faults.add(field, unknown_key(field.key, known));
        }
    }
}

const Field* Section::find(std::string_view key) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(),
                                    [key](const Field& field) { return field.key == key; });
    return found == fields_.end() ? nullptr : &*found;
}

void Section::read_vector(std::string_view key, glm::dvec3& target, ParseNumber parse) const {
    const Field* field = find(key);
    if (!field) return;
    const std::string advice = "must be a list of three numbers, such as [1, 2, 0]";
    faults_.take(*field, numbers_of(field->value, 3, parse, advice).map([](const auto& numbers) {
        return glm::dvec3{numbers[0], numbers[1], numbers[2]};
    }),
                 target);
}

void Section::read_pair(std::string_view key, std::array<double, 2>& target,
                        ParseNumber parse) const {
    const Field* field = find(key);
    if (!field) return;
    const std::string advice = "must be a list of two numbers, such as [1, 2]";
    faults_.take(*field, numbers_of(field->value, 2, parse, advice).map([](const auto& numbers) {
        return std::array{numbers[0], numbers[1]};
    }),
                 target);
}

}  // namespace scipd::daemon
