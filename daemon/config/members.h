// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Tables that say under which key a member of a struct stands and how it is read. What reads a part
// of a configuration makes such a table. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/expected.h"
#include "sim/loaders/yaml/yaml_section.h"

namespace scipd::daemon {

/// A member and how it is read.
template <class Struct>
struct Member {
    std::string_view key;
    void (*read)(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults);
};

template <auto member, auto parse, class Struct>
void read_as(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    faults.take(field, sim::text_of(field.value).and_then(parse), target.*member);
}

inline constexpr std::size_t longest_list = 64;

/// The items of a list, each with the path of the list and its own line.
sim::Expected<std::vector<sim::YamlField>> items(const sim::YamlField& list);

/// Every item of a list, or the fault of the first that is wrong.
template <auto parse>
auto values_of(const sim::YamlField& list) {
    using Value = typename decltype(parse({}))::value_type;
    return items(list).and_then([](const std::vector<sim::YamlField>& fields) {
        sim::Expected<std::vector<Value>> values{tl::in_place};
        for (const sim::YamlField& item : fields) {
            const auto value = sim::text_of(item.value).and_then(parse);
            if (!value) return decltype(values){tl::unexpect, value.error()};
            values->push_back(*value);
        }
        return values;
    });
}

template <auto member, auto parse, class Struct>
void read_list(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    faults.take(field, values_of<parse>(field), target.*member);
}

/// The keys of a table, and these.
template <class Table>
std::vector<std::string_view> keys_of(const Table& table,
                                      std::span<const std::string_view> besides = {}) {
    std::vector<std::string_view> keys(besides.begin(), besides.end());
    for (const auto& member : table)
        keys.push_back(member.key);
    return keys;
}

template <class Table, class Struct>
void read_members(const sim::YamlSection& section, const Table& table, Struct& target,
                  sim::YamlFaults& faults) {
    for (const auto& member : table) {
        if (const sim::YamlField* field = section.find(member.key))
            member.read(*field, target, faults);
    }
}

/// A list of maps. `needed`: the keys that each must have.
template <class Item, const auto& table>
std::vector<Item> maps_of(const sim::YamlField& list, sim::YamlFaults& faults,
                          std::initializer_list<std::string_view> needed = {}) {
    std::vector<Item> read;
    std::vector<sim::YamlField> maps;
    faults.take(list, items(list), maps);
    for (const sim::YamlField& item : maps) {
        const sim::YamlSection section{item, keys_of(table), faults};
        for (const std::string_view key : needed) {
            if (!section.find(key)) faults.add(item, "needs " + std::string(key));
        }
        read_members(section, table, read.emplace_back(Item{}), faults);
    }
    return read;
}

/// A map within the map.
template <auto member, const auto& table, class Struct>
void read_map(const sim::YamlField& field, Struct& target, sim::YamlFaults& faults) {
    const sim::YamlSection section{field, keys_of(table), faults};
    read_members(section, table, target.*member, faults);
}

}  // namespace scipd::daemon
