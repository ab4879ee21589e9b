// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/faults/read_fault.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

#include "daemon/config/members.h"
#include "daemon/config/numbers.h"
#include "daemon/config/values.h"
#include "protocol/command_table.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/poses/small_json.h"
#include "sim/text/near_word.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::daemon {
namespace {

using Json = nlohmann::ordered_json;
using sim::Expected;

constexpr std::array<std::string_view, 7> keys_of_all{"kind",  "at",     "for", "until",
                                                      "every", "jitter", "seed"};
constexpr std::size_t longest_fault = 16 << 10;
constexpr const char* quoted = "!";  ///< the tag of a text in quotes
constexpr int most_scans = 999'999'999;
constexpr int most_requests = 1'000'000;

Expected<int> parse_scan_number(std::string_view text) {
    return parse_whole(text, 0, most_scans);
}

Expected<int> parse_scan_count(std::string_view text) {
    return parse_whole(text, 1, most_scans);
}

Expected<int> parse_nth(std::string_view text) {
    return parse_whole(text, 1, most_requests);
}

Expected<sim::Time> parse_told_time(std::string_view text) {
    const auto told = sim::parse_stamp(text);
    if (!told || *told < sim::Time::zero())
        return sim::refuse("must be a time from 0 to 9e9 s, not " + sim::quote(text));
    return *told;
}

Expected<sim::Time> parse_lasting(std::string_view text) {
    return parse_span(text).and_then([&](sim::Time time) -> Expected<sim::Time> {
        if (time >= std::chrono::milliseconds{1}) return time;
        return sim::refuse("must be at least 0.001 s, not " + sim::quote(text));
    });
}

template <class Value, auto parse, class Choice>
void read_as_choice(const sim::YamlField& field, Choice& choice, sim::YamlFaults& faults) {
    const auto wrapped = [](auto value) { return Value{std::move(value)}; };
    faults.take(field, sim::text_of(field.value).and_then(parse).map(wrapped), choice);
}

constexpr std::array<Member<FaultStart>, 5> starts{{
    {"scan", read_as_choice<AtScan, parse_scan_number>},
    {"time_s", read_as_choice<AtTime, parse_told_time>},
    {"scans", read_as_choice<AfterScans, parse_scan_number>},
    {"s", read_as_choice<AfterTime, parse_span>},
    {"request", read_as_choice<AtRequest, parse_code>},
}};
constexpr std::array<Member<FaultEnd>, 2> ends{{
    {"scans", read_as_choice<ForScans, parse_scan_count>},
    {"s", read_as_choice<ForTime, parse_lasting>},
}};
constexpr std::array<Member<FaultRepetition>, 2> distances{{
    {"scans", read_as_choice<Every<std::int64_t>, parse_scan_count>},
    {"s", read_as_choice<Every<sim::Time>, parse_lasting>},
}};
constexpr std::array<Member<FaultRepetition>, 2> jitters{{
    {"scans", read_as_choice<Every<std::int64_t>, parse_scan_number>},
    {"s", read_as_choice<Every<sim::Time>, parse_span>},
}};

/// A map that has one of the keys of the table, and none but `besides`.
template <class Table, class Choice>
sim::YamlSection read_one_of(const Table& table, const sim::YamlField& map, Choice& choice,
                             sim::YamlFaults& faults,
                             std::span<const std::string_view> besides = {}) {
    const std::size_t before = faults.count();
    sim::YamlSection section{map, keys_of(table, besides), faults};
    const bool sound = faults.count() == before;
    const auto given =
        std::ranges::count_if(table, [&](const auto& member) { return section.find(member.key); });
    if (given == 0 && sound) faults.add(map, "needs one of " + sim::listed(keys_of(table)));
    if (given > 1) faults.add(map, "must have only one of " + sim::listed(keys_of(table)));
    read_members(section, table, choice, faults);
    return section;
}

void read_start(const sim::YamlField& map, FaultStart& start, sim::YamlFaults& faults) {
    static constexpr std::array<std::string_view, 1> besides{"nth"};
    const sim::YamlSection section = read_one_of(starts, map, start, faults, besides);
    const sim::YamlField* const nth = section.find("nth");
    if (!nth) return;
    int number = 1;
    faults.take(*nth, sim::text_of(nth->value).and_then(parse_nth), number);
    if (!section.find("request")) faults.add(*nth, "is of request; leave it out");
    if (auto* const request = std::get_if<AtRequest>(&start)) request->nth = number;
}

void read_end(const sim::YamlSection& section, FaultEnd& end, sim::YamlFaults& faults) {
    const sim::YamlField* const lasts = section.find("for");
    const sim::YamlField* const until = section.find("until");
    if (lasts) read_one_of(ends, *lasts, end, faults);
    if (until) read_as_choice<UntilRequest, parse_code>(*until, end, faults);
    if (lasts && until) faults.add(*until, "cannot stand beside for; leave one of them out");
}

template <class Distance>
Expected<> add_jitter(Every<Distance>& every, const FaultRepetition& jitter) {
    const auto* const given = std::get_if<Every<Distance>>(&jitter);
    if (!given) return sim::refuse("must be of the same unit as every");
    if (2 * given->distance >= every.distance)
        return sim::refuse("must be less than half of every");
    every.jitter = given->distance;
    return {};
}

void read_jitter(const sim::YamlField& field, FaultRepetition& every, sim::YamlFaults& faults) {
    FaultRepetition jitter;
    read_one_of(jitters, field, jitter, faults);
    if (std::holds_alternative<std::monostate>(jitter)) return;
    if (auto* const scans = std::get_if<Every<std::int64_t>>(&every))
        faults.require(field, add_jitter(*scans, jitter));
    if (auto* const time = std::get_if<Every<sim::Time>>(&every))
        faults.require(field, add_jitter(*time, jitter));
}

void read_repetition(const sim::YamlSection& section, FaultRepetition& repetition,
                     sim::YamlFaults& faults) {
    const sim::YamlField* const every = section.find("every");
    const sim::YamlField* const jitter = section.find("jitter");
    const sim::YamlField* const at = section.find("at");
    if (every) read_one_of(distances, *every, repetition, faults);
    if (every && at) faults.add(*at, "cannot stand beside every; leave one of them out");
    if (jitter) read_jitter(*jitter, repetition, faults);
    if (jitter && !every) faults.add(*jitter, "needs every, which it varies");
}

std::string unknown_kind(const std::string& name, std::span<const std::string_view> names) {
    const auto near = sim::meant(name, names);
    return "there is no kind " + sim::quote(name) + "; " +
           (near ? "did you mean " + std::string(*near) + "? There are " : "there are ") +
           sim::listed(names);
}

/// Null: it has faults, or the whole is no map.
const FaultKind* read_kind(const sim::YamlField& map, const FaultKinds& kinds,
                           sim::YamlFaults& faults) {
    if (!map.value.IsMap()) return nullptr;
    std::vector<std::string_view> names;
    std::ranges::transform(kinds, std::back_inserter(names), &FaultKind::name);
    const auto field = sim::entry_of(map, "kind");
    if (!field) {
        faults.add(map, "needs a kind: one of " + sim::listed(names));
        return nullptr;
    }
    const auto name = sim::text_of(field->value);
    const auto found = std::ranges::find(kinds, name.value_or(""), &FaultKind::name);
    if (found != kinds.end()) return *found;
    faults.add(*field, name ? unknown_kind(*name, names) : name.error().why);
    return nullptr;
}

/// Where the kind is unknown, those of all: nobody can tell which is too many.
std::vector<std::string_view> known_keys(const FaultKind* kind, const FaultKinds& kinds,
                                         std::span<const std::string_view> also) {
    std::vector<std::string_view> keys(keys_of_all.begin(), keys_of_all.end());
    keys.insert(keys.end(), also.begin(), also.end());
    for (const FaultKind* const other : kinds) {
        if (kind == nullptr || other == kind) std::ranges::copy(other->keys(), back_inserter(keys));
    }
    return keys;
}

Json said_by(const YAML::Node& node) {
    auto said = Json::object();
    if (node.IsMap()) {
        for (const auto& entry : node)
            said[entry.first.Scalar()] = said_by(entry.second);
        return said;
    }
    if (node.IsSequence()) {
        said = Json::array();
        for (const YAML::Node& item : node)
            said.push_back(said_by(item));
        return said;
    }
    if (node.Tag() == quoted) return node.Scalar();
    said = Json::parse(node.Scalar(), nullptr, false);
    if (said.is_number() || said.is_boolean()) return said;
    return node.Scalar();
}

void require_an_end(const sim::YamlSection& section, const FaultPlan& plan,
                    sim::YamlFaults& faults) {
    const sim::YamlField* const every = section.find("every");
    const bool lasts = plan.kind != nullptr && !plan.kind->momentary &&
                       section.find("for") == nullptr && section.find("until") == nullptr;
    if (every && lasts)
        faults.add(*every, "needs for or until: what does not end does not begin again");
}

/// As if it had been read from YAML, which tells "1" from 1 by its quotes.
YAML::Node yaml_of(const Json& json) {
    if (json.is_object()) {
        YAML::Node map{YAML::NodeType::Map};
        for (const auto& [key, value] : json.items())
            map.force_insert(key, yaml_of(value));
        return map;
    }
    if (json.is_array()) {
        YAML::Node list{YAML::NodeType::Sequence};
        for (const Json& item : json)
            list.push_back(yaml_of(item));
        return list;
    }
    if (json.is_null()) return YAML::Node{YAML::NodeType::Null};
    if (!json.is_string()) return YAML::Node{json.dump()};
    YAML::Node text{json.get_ref<const std::string&>()};
    text.SetTag(quoted);
    return text;
}

}  // namespace

std::optional<FaultPlan> read_fault(const sim::YamlField& map,
                                    std::span<const std::string_view> also, sim::YamlFaults& faults,
                                    const FaultKinds& kinds) {
    const std::size_t before = faults.count();
    FaultPlan plan;
    plan.kind = read_kind(map, kinds, faults);
    const sim::YamlSection section{map, known_keys(plan.kind, kinds, also), faults,
                                   "{kind: stall, for: {s: 2}}"};
    if (const sim::YamlField* const at = section.find("at")) read_start(*at, plan.start, faults);
    read_end(section, plan.end, faults);
    read_repetition(section, plan.every, faults);
    require_an_end(section, plan, faults);
    section.read("seed", plan.seed, parse_seed);
    if (plan.kind) plan.make = plan.kind->read(map, section, faults);
    if (faults.count() != before) return std::nullopt;
    auto said = said_by(map.value);
    for (const std::string_view key : also)
        said.erase(std::string(key));
    constexpr bool ascii = true;
    plan.said = said.dump(-1, ' ', ascii, Json::error_handler_t::replace);
    return plan;
}

Expected<FaultPlan> parse_fault(const std::string& json, const FaultKinds& kinds) {
    if (json.size() > longest_fault) return sim::refuse("must be at most 16 KiB");
    const auto object = sim::parse_ordered_json(json);
    if (!object && !object.error().field.empty()) return tl::unexpected(object.error());
    if (!object) return sim::refuse("must be a JSON object: " + object.error().why);
    if (!object->is_object())
        return sim::refuse(R"(must be a JSON object such as {"kind":"reboot"})");
    sim::YamlFaults faults{"fault"};
    try {
        if (auto plan = read_fault({{}, {}, 1, yaml_of(*object)}, {}, faults, kinds))
            return *std::move(plan);
    } catch (const sim::LoadError&) {
        // The faults have it: there were too many.
    }
    return tl::unexpected(*faults.first());
}

}  // namespace scipd::daemon
