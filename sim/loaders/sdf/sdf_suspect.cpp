// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_suspect.h"

#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/sdf/sdf_names.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;
using Test = std::function<bool(const XMLElement&)>;

/// The first match in the order of the document.
XMLElement* first_of(XMLElement& element, const Test& is_it) {
    if (is_it(element)) return &element;
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (auto* found = first_of(*child, is_it)) return found;
    }
    return nullptr;
}

/// One step of a path: model[@name="m"].
struct Step {
    std::string name;
    std::string attribute;
    std::string value;

    [[nodiscard]] bool fits(const XMLElement& element) const {
        if (element.Name() != name) return false;
        const char* has = element.Attribute(attribute.c_str());
        return attribute.empty() || (has != nullptr && has == value);
    }
};

std::vector<Step> steps_of(const std::string& path) {
    // A value may hold any character, slashes too.
    static const std::regex step{R"re(/([^/\[]+)(?:\[@([^=]+)="(.*?)"\])?(?:\[[^/]*\])?(?=/|$))re"};
    std::vector<Step> steps;
    for (std::sregex_iterator at{path.begin(), path.end(), step}, end; at != end; ++at)
        steps.push_back({(*at)[1], (*at)[2], (*at)[3]});
    return steps;
}

void follow(XMLElement& element, const std::vector<Step>& steps, std::size_t at,
            std::vector<XMLElement*>& found) {
    if (!steps[at].fits(element)) return;
    if (at + 1 == steps.size()) return found.push_back(&element);
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement())
        follow(*child, steps, at + 1, found);
}

XMLElement* at_path(const std::string& path, int line, XMLElement& root) {
    const auto steps = steps_of(path);
    if (steps.empty()) return nullptr;
    std::vector<XMLElement*> found;
    follow(root, steps, 0, found);
    for (auto* element : found) {
        if (element->GetLineNum() == line) return element;
    }
    if (!found.empty()) return found.front();
    return first_of(root, [&](const XMLElement& element) {
        return element.GetLineNum() == line && element.Name() == steps.back().name;
    });
}

bool is_called(const XMLElement& element, std::string_view kind, const std::string& name) {
    const std::string_view is = element.Name();
    return (is == kind || (kind == "model" && is == "include")) && own_name(element) == name;
}

/// "... specified by link with name[k] ... in model with name[m]."
XMLElement* named_by(const std::string& message, XMLElement& root) {
    static const std::regex specified{
        R"(specified by (?:\w+ )?(link|joint|frame|model) with name ?\[([^\]]*)\])"};
    static const std::regex any{
        R"((visual|collision|link|joint|frame|model) with name ?\[([^\]]*)\])", std::regex::icase};
    static const std::regex container{R"( in (model|world) with name ?\[([^\]]*)\])"};
    std::smatch what;
    if (!std::regex_search(message, what, specified) && !std::regex_search(message, what, any)) {
        return nullptr;
    }
    std::string kind = what[1];
    kind[0] = static_cast<char>(kind[0] | ('a' - 'A'));
    std::smatch where;
    const bool is_in = std::regex_search(message, where, container);
    return first_of(root, [&](const XMLElement& element) {
        if (!is_called(element, kind, what[2])) return false;
        const auto* outer = element.Parent()->ToElement();
        return !is_in || (outer != nullptr && is_called(*outer, where[1].str(), where[2]));
    });
}

/// "... vertex [m::f]": the path of a frame.
XMLElement* at_vertex(const std::string& message, XMLElement& root) {
    static const std::regex vertex{R"(vertex \[([^\]]*)\])"};
    std::smatch what;
    if (!std::regex_search(message, what, vertex)) return nullptr;
    return first_of(root,
                    [&](const XMLElement& element) { return path_of(element) == what[1].str(); });
}

}  // namespace

XMLElement* suspect_of(const sdf::Error& error, XMLElement& root) {
    // std::regex takes stack for every character.
    constexpr std::size_t longest = 4000;
    if (error.Message().size() > longest || error.XmlPath().value_or("").size() > longest) {
        return nullptr;
    }
    if (error.XmlPath()) return at_path(*error.XmlPath(), error.LineNumber().value_or(0), root);
    if (auto* element = named_by(error.Message(), root)) return element;
    return at_vertex(error.Message(), root);
}

}  // namespace scipd::sim
