// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipctl/fault_words.h"

#include <cstdio>
#include <utility>

#include <yaml-cpp/yaml.h>

#include "tools/options.h"
#include "tools/scipctl/sensor_question.h"

namespace scipd::tools {
namespace {

using Json = ControlClient::Json;
using Pair = std::pair<std::string, std::string>;

constexpr int deepest = 8;

/// A number, true and the like as JSON has them; all else is text: 0L, and 02 as well.
Json scalar_of(const YAML::Node& node) {
    const std::string& text = node.Scalar();
    if (node.Tag() == "!") return text;  // in quotes
    const Json value = Json::parse(text, nullptr, false);
    return value.is_discarded() || value.is_structured() || value.is_string() ? Json(text) : value;
}

Json json_of(const YAML::Node& node, int depth = 0) {
    if (depth > deepest) throw WrongInput("a value nests too deep");
    if (node.IsScalar()) return scalar_of(node);
    if (node.IsSequence()) {
        Json list = Json::array();
        for (const YAML::Node& item : node)
            list.push_back(json_of(item, depth + 1));
        return list;
    }
    if (!node.IsMap()) return nullptr;
    Json map = Json::object();
    for (const auto& entry : node)
        map[entry.first.Scalar()] = json_of(entry.second, depth + 1);
    return map;
}

Json value_of(const std::string& text) {
    try {
        return json_of(YAML::Load(text));
    } catch (const YAML::Exception&) {
        throw WrongInput("\"" + text + "\" is no value: write it as YAML or JSON");
    }
}

Pair pair_of(const std::string& text, const std::string& examples) {
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
        throw WrongInput("\"" + text + "\" is no KEY=VALUE, such as " + examples);
    return {text.substr(0, equals), text.substr(equals + 1)};
}

/// An option such as --at scan=12.
void add_option(Json& fault, const std::string& key, const std::string& text,
                const std::string& examples) {
    if (text.empty()) return;
    auto [name, value] = pair_of(text, examples);
    Json map = Json::object();
    const auto colon = name == "request" ? value.find(':') : std::string::npos;
    if (colon != std::string::npos) {
        map["request"] = value.substr(0, colon);
        map["nth"] = value_of(value.substr(colon + 1));
    } else {
        map[name] = name == "request" ? Json(value) : value_of(value);
    }
    fault[key] = std::move(map);
}

}  // namespace

/// bytes.rate=0.01 becomes {"bytes":{"rate":0.01}}.
void add_member(Json& map, const std::string& text, const std::string& examples) {
    const auto [key, value] = pair_of(text, examples);
    Json* target = &map;
    std::size_t begin = 0;
    for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
        target = &(*target)[key.substr(begin, dot - begin)];
        if (!target->is_null() && !target->is_object())
            throw WrongInput("\"" + text + "\" goes into what is no map");
        begin = dot + 1;
    }
    Json& member = (*target)[key.substr(begin)];
    if (!member.is_null())
        throw WrongInput("\"" + text + "\" says a second time what " + key + " is");
    member = value_of(value);
}

Json fault_of(const FaultWords& words) {
    Json fault{{"kind", words.kind}};
    for (const std::string& member : words.members)
        add_member(fault, member, "ms=50 or bytes.rate=0.01");
    add_option(fault, "at", words.at, "scan=120, time_s=12.5, scans=40, s=1 or request=MD:2");
    add_option(fault, "for", words.how_long, "scans=40 or s=1");
    if (!words.until.empty()) fault["until"] = words.until;
    add_option(fault, "every", words.every, "s=10 or scans=400");
    add_option(fault, "jitter", words.jitter, "s=2 or scans=80");
    if (!words.seed.empty()) fault["seed"] = value_of(words.seed);
    return fault;
}

std::string line_of(const Json& log_entry) {
    const Json& request = log_entry.at("request");
    char place[64];
    std::snprintf(place, sizeof place, "%5llu  %10.3f s  scan %-6lld",
                  log_entry.at("n").get<unsigned long long>(), log_entry.at("time_s").get<double>(),
                  log_entry.at("scan").get<long long>());
    return place + std::string("  fault ") + log_entry.at("id").dump() + " " +
           log_entry.at("kind").get<std::string>() + ": " +
           log_entry.at("what").get<std::string>() +
           (request.is_null() ? "" : "  (" + request.get<std::string>() + ")");
}

}  // namespace scipd::tools
