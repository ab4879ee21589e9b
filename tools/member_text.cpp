// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/member_text.h"

#include <yaml-cpp/yaml.h>

#include "tools/options.h"

namespace scipd::tools {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

Json value_of(const std::string& text) {
    try {
        return json_of(YAML::Load(text));
    } catch (const YAML::Exception&) {
        throw WrongInput("\"" + text + "\" is no value: write it as YAML or JSON");
    }
}

std::pair<std::string, std::string> pair_of(const std::string& text, const std::string& examples) {
    const auto equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == text.size())
        throw WrongInput("\"" + text + "\" is no KEY=VALUE, such as " + examples);
    return {text.substr(0, equals), text.substr(equals + 1)};
}

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

}  // namespace scipd::tools
