// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The <experimental:params> of an <include>.
#include <string_view>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/sdf_documents.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;
using Skipped = std::function<void(const XMLElement& param, const std::string& why)>;

constexpr std::string_view colons = "::";

/// The child with this name attribute, of this kind if one is given.
XMLElement* named_child(XMLElement& outer, std::string_view name, std::string_view kind = {}) {
    for (auto* child = outer.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
        if (attribute(*child, "name") == name && (kind.empty() || kind == child->Name())) {
            return child;
        }
    }
    return nullptr;
}

/// The element that a path of names leads to: LINK::VISUAL. Null if to none.
XMLElement* element_at(XMLElement& model, std::string_view path, std::string_view kind = {}) {
    if (path.empty()) return &model;
    // Names may hold colons themselves.
    if (auto* whole = named_child(model, path, kind)) return whole;
    for (auto at = path.find(colons); at != path.npos; at = path.find(colons, at + 1)) {
        auto* outer = named_child(model, path.substr(0, at));
        if (outer == nullptr) continue;
        if (auto* found = element_at(*outer, path.substr(at + colons.size()), kind)) return found;
    }
    return nullptr;
}

XMLElement& add_copy(const XMLElement& param, XMLElement& outer) {
    auto* copy = outer.InsertEndChild(param.DeepClone(outer.GetDocument()))->ToElement();
    copy->DeleteAttribute("element_id");
    copy->DeleteAttribute("action");
    return *copy;
}

void remove(XMLElement& element) {
    element.Parent()->DeleteChild(&element);
}

/// The child of `outer` that a child of a param speaks of; null if there is none.
XMLElement* same_child(const XMLElement& child, XMLElement& outer) {
    const std::string name = attribute(child, "name");
    return name.empty() ? outer.FirstChildElement(child.Name())
                        : named_child(outer, name, child.Name());
}

/// Takes over the text, the attributes and the children of a param; children that are not there
/// are added.
void modify(const XMLElement& param, XMLElement& element) {
    for (const auto* is = param.FirstAttribute(); is != nullptr; is = is->Next()) {
        const std::string_view name = is->Name();
        if (name == "element_id" || name == "action" || name == "name") continue;
        element.SetAttribute(is->Name(), is->Value());
    }
    if (param.GetText() != nullptr) element.SetText(param.GetText());
    for (const XMLElement& child : Children(param)) {
        if (auto* same = same_child(child, element)) {
            modify(child, *same);
        } else {
            (void)add_copy(child, element);
        }
    }
}

class Params {
  public:
    Params(XMLElement& model, const Skipped& skipped) : model_(model), skipped_(skipped) {}

    void apply(const XMLElement& param) {
        const std::string id = attribute(param, "element_id");
        const std::string action = attribute(param, "action");
        const bool is_said = param.Attribute("element_id") != nullptr;
        if (action == "add" && is_said) return add(param, id);
        if (id.empty()) return skipped_(param, "has no element_id");
        auto* element = element_at(model_, id, param.Name());
        if (element == nullptr) {
            return skipped_(param, "the model has no <" + std::string{param.Name()} + "> " +
                                       quote(id, whole_path));
        }
        if (action.empty()) return apply_children(param, *element);
        apply(param, action, *element);
    }

  private:
    /// The id is that of the element around the new one, as in libsdformat (ParamPassing.cc). Where
    /// the new one has no name, the last name of the id is taken for it.
    void add(const XMLElement& param, const std::string& id) {
        std::string name = attribute(param, "name");
        std::string outer_id = id;
        if (name.empty()) {
            const auto at = id.rfind(colons);
            outer_id = at == id.npos ? "" : id.substr(0, at);
            name = id.substr(at == id.npos ? 0 : at + colons.size());
        }
        auto* outer = element_at(model_, outer_id);
        if (outer == nullptr) return skipped_(param, "the model has no " + quote(outer_id));
        if (name.empty()) return skipped_(param, "has no name");
        add_copy(param, *outer).SetAttribute("name", name.c_str());
    }

    void apply(const XMLElement& param, const std::string& action, XMLElement& element) {
        if (action == "remove") return remove(element);
        if (action == "modify") {
            const std::string name = attribute(param, "name");
            if (!name.empty() && name != attribute(element, "name")) {
                skipped_(param, "cannot rename it to " + quote(name));
            }
            return modify(param, element);
        }
        if (action != "replace") return skipped_(param, "has the unknown action " + quote(action));
        XMLElement& outer = *element.Parent()->ToElement();
        XMLElement& copy = add_copy(param, outer);
        if (attribute(copy, "name").empty() && element.Attribute("name") != nullptr) {
            copy.SetAttribute("name", element.Attribute("name"));
        }
        remove(element);
    }

    /// A param without an action has one for each of its children.
    void apply_children(const XMLElement& param, XMLElement& element) {
        for (const XMLElement& child : Children(param)) {
            const std::string action = attribute(child, "action");
            auto* same = same_child(child, element);
            if (action == "add") {
                (void)add_copy(child, element);
            } else if (same == nullptr) {
                skipped_(child, "the element has no <" + std::string{child.Name()} + ">");
            } else {
                apply(child, action.empty() ? "modify" : action, *same);
            }
        }
    }

    XMLElement& model_;
    const Skipped& skipped_;
};

}  // namespace

void apply_params(const XMLElement& params, XMLElement& model, const Skipped& skipped) {
    Params apply(model, skipped);
    for (const XMLElement& param : Children(params))
        apply.apply(param);
}

}  // namespace scipd::sim
