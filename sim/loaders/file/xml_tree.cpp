// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/xml_tree.h"

namespace scipd::sim {

using tinyxml2::XMLElement;

const XMLElement* inside(const XMLElement& outer, std::initializer_list<const char*> names) {
    const XMLElement* at = &outer;
    for (const char* name : names) {
        at = at->FirstChildElement(name);
        if (at == nullptr) break;
    }
    return at;
}

std::string attribute(const XMLElement& element, const char* name) {
    const char* value = element.Attribute(name);
    return value == nullptr ? "" : value;
}

std::string text_of(const XMLElement* element) {
    const char* text = element == nullptr ? nullptr : element->GetText();
    return text == nullptr ? "" : text;
}

void for_each(XMLElement& element, const std::function<void(XMLElement&)>& visit) {
    visit(element);
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        for_each(*child, visit);
    }
}

void delete_children(XMLElement& element, const std::function<bool(XMLElement&)>& is_unwanted) {
    for (auto* child = element.FirstChildElement(); child != nullptr;) {
        auto* next = child->NextSiblingElement();
        if (is_unwanted(*child)) element.DeleteChild(child);
        child = next;
    }
}

}  // namespace scipd::sim
