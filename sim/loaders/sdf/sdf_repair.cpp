// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_repair.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <set>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/line_for_line.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/loaders/sdf/sdf_names.h"
#include "sim/loaders/sdf/sdf_suspect.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

constexpr std::size_t longest_told = 200;

bool is_holder(const XMLElement& element) {
    return is_one_of(element,
                     {"visual", "collision", "link", "frame", "joint", "model", "include"});
}

XMLElement* outer(XMLElement& element) {
    return element.Parent() == nullptr ? nullptr : element.Parent()->ToElement();
}

/// The element to remove for a fault in `element`; null if that would be the whole document.
XMLElement* goes_with(XMLElement& element) {
    bool matters = is_one_of(element, {"pose", "geometry"});
    XMLElement* holder = &element;
    while (holder != nullptr && !is_holder(*holder)) {
        holder = outer(*holder);
        matters = matters || (holder != nullptr && is_one_of(*holder, {"geometry"}));
    }
    if (holder == nullptr) return nullptr;
    return matters || is_one_of(*holder, {"frame", "joint", "include"}) ? holder : &element;
}

bool is_value(const XMLElement& element, const sdf::Error& error) {
    return !is_holder(element) && error.Message().starts_with("Error reading element");
}

std::string what_is_wrong(const XMLElement& element, const sdf::Error& error) {
    if (!is_value(element, error)) return error.Message();
    const char* text = element.GetText();
    return std::string{"its <"} + element.Name() + "> " +
           (text == nullptr ? "" : '\'' + printable(text, longest_told) + "' ") + "cannot be read";
}

std::string place_of(const XMLElement& element, const SdfDocument& document) {
    const auto file = document.file.string();
    return document.is_converted ? file + ": "
                                 : file + ':' + std::to_string(element.GetLineNum()) + ": ";
}

/// The warning for the removal of a whole visual, link or model, or of a part that it can do
/// without.
std::string warning_of(XMLElement& gone, const std::string& why, const SdfDocument& document) {
    const XMLElement* holder = &gone;
    while (!is_holder(*holder))
        holder = holder->Parent()->ToElement();
    const std::string kind = is_one_of(*holder, {"include"}) ? "model" : holder->Name();
    const bool is_seen = !is_one_of(*holder, {"frame", "joint"});
    std::string end = why.ends_with('.') ? why.substr(0, why.size() - 1) : why;
    end += holder != &gone ? "; ignored"
           : is_seen       ? "; left out, no scanner sees it"
                           : "; left out";
    const std::string name = path_of(*holder);
    return place_of(gone, document) + kind + (name.empty() ? "" : ' ' + name) + ": " + end;
}

bool has_the_same_in_it(const XMLElement& one, const XMLElement& other) {
    const auto* a = one.FirstAttribute();
    const auto* b = other.FirstAttribute();
    for (; a != nullptr && b != nullptr; a = a->Next(), b = b->Next()) {
        if (std::string_view{a->Name()} != b->Name() || std::string_view{a->Value()} != b->Value())
            return false;
    }
    return a == b && one.FirstChildElement() == nullptr && other.FirstChildElement() == nullptr &&
           text_of(&one) == text_of(&other);
}

/// Finds `suspect` and all elements with the same value. The library cannot read those either, and
/// each would cost another round.
void find_alike(const XMLElement& suspect, XMLElement& in, std::vector<XMLElement*>& found) {
    const bool is_alike = std::string_view{in.Name()} == suspect.Name() && in.Parent() != nullptr &&
                          std::string_view{in.Parent()->Value()} == suspect.Parent()->Value() &&
                          has_the_same_in_it(in, suspect);
    if (&in == &suspect || is_alike) found.push_back(&in);
    for (auto* child = in.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement())
        find_alike(suspect, *child, found);
}

bool lies_in(const XMLElement& element, const std::set<XMLElement*>& others) {
    for (const auto* up = element.Parent(); up != nullptr; up = up->Parent()) {
        if (std::ranges::any_of(others, [&](const auto* other) { return other == up; }))
            return true;
    }
    return false;
}

void take(const std::set<XMLElement*>& gone) {
    std::vector<XMLElement*> tops;
    std::ranges::copy_if(gone, std::back_inserter(tops),
                         [&](const auto* element) { return !lies_in(*element, gone); });
    for (XMLElement* element : tops)
        element->Parent()->DeleteChild(element);
}

/// A document with one model in its world, and with the frames that it may be relative to.
std::string text_of_one(const XMLElement& model) {
    XMLDocument copy;
    const auto* world = model.Parent()->ToElement();
    auto* root = copy.InsertEndChild(world->Parent()->ShallowClone(&copy));
    auto* inside = root->InsertEndChild(world->ShallowClone(&copy));
    for (const auto* child = world->FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (child == &model || is_one_of(*child, {"frame"})) {
            inside->InsertEndChild(child->DeepClone(&copy));
        }
    }
    return line_for_line(copy);
}

void finish(XMLDocument& xml, SdfDocument& document) {
    drop_empty_models(*xml.RootElement());
    document.text = line_for_line(xml);
}

bool is_echo(const sdf::Error& error, const std::string& last_path) {
    const auto message = error.Message();
    // After one unreadable element, the library also complains about every element around it; after
    // one missing frame, about the whole graph of frames.
    if (message.starts_with("Error reading element")) {
        return !last_path.empty() && last_path.starts_with(error.XmlPath().value_or(""));
    }
    return message.starts_with("Unable to read file") ||
           message.starts_with("Unable to read SDF string") ||
           message.starts_with("Failed to load a world") ||
           error.Code() == sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR ||
           error.Code() == sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR;
}

}  // namespace

std::vector<sdf::Error> without_echoes(const sdf::Errors& errors) {
    std::vector<sdf::Error> own;
    std::string last_path;
    for (const auto& error : errors) {
        if (is_echo(error, last_path)) continue;
        last_path = error.XmlPath().value_or("");
        own.push_back(error);
    }
    return own.empty() ? errors : own;
}

std::vector<std::string> take_out(const sdf::Errors& errors, SdfDocument& document) {
    XMLDocument xml;
    if (xml.Parse(document.text.c_str()) != tinyxml2::XML_SUCCESS) return {};
    std::set<XMLElement*> all_gone;
    std::vector<std::string> warnings;
    for (const auto& error : without_echoes(errors)) {
        auto* first = suspect_of(error, *xml.RootElement());
        std::vector<XMLElement*> suspects;
        if (first != nullptr && is_value(*first, error)) {
            find_alike(*first, *xml.RootElement(), suspects);
        } else if (first != nullptr) {
            suspects.push_back(first);
        }
        for (XMLElement* suspect : suspects) {
            auto* gone = goes_with(*suspect);
            if (gone == nullptr || !all_gone.insert(gone).second) continue;
            warnings.push_back(warning_of(*gone, what_is_wrong(*suspect, error), document));
        }
    }
    take(all_gone);
    finish(xml, document);
    return warnings;
}

void drop_read(const sdf::Error& error, SdfDocument& document) {
    XMLDocument xml;
    xml.Parse(document.text.c_str());
    auto* world = xml.Error() ? nullptr : xml.RootElement()->FirstChildElement("world");
    auto* at = xml.Error() ? nullptr : suspect_of(error, *xml.RootElement());
    while (at != nullptr && at->Parent() != world)
        at = outer(*at);
    if (world == nullptr || at == nullptr) return;
    for (auto* child = world->FirstChildElement(); child != at;) {
        auto* next = child->NextSiblingElement();
        if (is_one_of(*child, {"model", "include"})) world->DeleteChild(child);
        child = next;
    }
    document.text = line_for_line(xml);
}

std::vector<std::string> take_out_models(
    SdfDocument& document, const std::function<std::string(const std::string&)>& fault_of) {
    XMLDocument xml;
    xml.Parse(document.text.c_str());
    auto* world = xml.Error() ? nullptr : xml.RootElement()->FirstChildElement("world");
    if (world == nullptr) return {};
    std::set<XMLElement*> all_gone;
    std::vector<std::string> warnings;
    for (auto* model = world->FirstChildElement(); model != nullptr;
         model = model->NextSiblingElement()) {
        if (!is_one_of(*model, {"model", "include"})) continue;
        const auto fault = fault_of(text_of_one(*model));
        if (fault.empty()) continue;
        all_gone.insert(model);
        warnings.push_back(warning_of(*model, fault, document));
    }
    take(all_gone);
    finish(xml, document);
    return warnings;
}

void take_out_includes(SdfDocument& document, const std::string& uri) {
    XMLDocument xml;
    if (xml.Parse(document.text.c_str()) != tinyxml2::XML_SUCCESS) return;
    std::set<XMLElement*> gone;
    const std::function<void(XMLElement&)> look = [&](XMLElement& element) {
        const auto* named = element.FirstChildElement("uri");
        if (is_one_of(element, {"include"}) && named != nullptr && named->GetText() != nullptr &&
            named->GetText() == uri) {
            gone.insert(&element);
        }
        for (auto* child = element.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            look(*child);
    };
    look(*xml.RootElement());
    take(gone);
    finish(xml, document);
}

}  // namespace scipd::sim
