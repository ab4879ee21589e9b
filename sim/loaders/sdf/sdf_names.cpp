// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_names.h"

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;
using Names = std::set<std::string, std::less<>>;

constexpr std::array frames{"link", "joint", "frame", "model", "include"};

bool is_kind(const XMLElement& element, std::string_view kind) {
    return element.Name() == kind;
}

bool is_merged(const XMLElement& element) {
    return is_kind(element, "include") && element.BoolAttribute("merge");
}

void set_name(XMLElement& element, const std::string& name) {
    if (!is_kind(element, "include")) return element.SetAttribute("name", name.c_str());
    auto* child = element.FirstChildElement("name");
    if (child == nullptr) child = element.InsertNewChildElement("name");
    child->SetText(name.c_str());
}

/// Names with a meaning of their own in the library.
bool is_reserved(std::string_view name) {
    return name == "world" || (name.size() >= 4 && name.starts_with("__") && name.ends_with("__"));
}

std::string free_name(const std::string& name, const Names& taken) {
    for (std::size_t i = 0;; ++i) {
        std::string candidate = name + '_' + std::to_string(i);
        if (!taken.contains(candidate)) return candidate;
    }
}

class NameMender {
  public:
    NameMender(const std::filesystem::path& file, const NameOfInclude& name_of)
        : file_(file), name_of_(name_of) {}

    std::vector<std::string> run(XMLElement& root) && {
        for (auto* child = root.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            // Nothing shows the name of a world, so no warning.
            if (is_kind(*child, "world") && own_name(*child).empty()) set_name(*child, "default");
        }
        mend_within(root);
        return std::move(warnings_);
    }

  private:
    void mend_within(XMLElement& outer) {
        mend_group(outer, frames);
        mend_group(outer, std::array{"visual"});
        mend_group(outer, std::array{"collision"});
        for (auto* child = outer.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement())
            mend_within(*child);
    }

    /// Mends the children of these kinds, which must not have the same names.
    void mend_group(XMLElement& outer, std::span<const char* const> kinds) {
        std::vector<XMLElement*> group;
        Names taken;
        for (auto* child = outer.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            const bool is_in =
                std::ranges::any_of(kinds, [&](const char* kind) { return is_kind(*child, kind); });
            if (!is_in || is_merged(*child)) continue;
            group.push_back(child);
            taken.insert(name_in(*child));
        }
        Names seen;
        for (XMLElement* element : group)
            mend(*element, taken, seen);
    }

    void mend(XMLElement& element, Names& taken, Names& seen) {
        const std::string name = name_in(element);
        if (own_name(element) != name) set_name(element, name);
        const bool is_include = is_kind(element, "include");
        // The included model has no name either, and a warning has said so.
        if (name.empty() && is_include) return;
        const bool is_second = !seen.insert(name).second;
        if (!name.empty() && !is_second && !is_reserved(name)) return;
        const std::string better = free_name(name.empty() ? element.Name() : name, taken);
        taken.insert(better);
        seen.insert(better);
        const std::string what = is_include ? "model" : element.Name();
        warnings_.push_back(file_.string() + ':' + std::to_string(element.GetLineNum()) + ": " +
                            (name.empty() ? "a " + what + " has no name"
                             : is_second  ? "there is another " + what + ' ' + path_of(element)
                                          : "no " + what + " may be called " + name) +
                            "; this one is called " + better);
        set_name(element, better);
    }

    [[nodiscard]] std::string name_in(const XMLElement& element) const {
        std::string name = own_name(element);
        return name.empty() && is_kind(element, "include") ? name_of_(element) : name;
    }

    const std::filesystem::path& file_;
    const NameOfInclude& name_of_;
    std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> mend_names(XMLElement& root, const std::filesystem::path& file,
                                    const NameOfInclude& name_of) {
    return NameMender{file, name_of}.run(root);
}

std::string own_name(const XMLElement& element) {
    return is_kind(element, "include") ? text_of(element.FirstChildElement("name"))
                                       : attribute(element, "name");
}

std::string path_of(const XMLElement& element) {
    std::string path;
    for (const auto* part = &element; part != nullptr && !is_kind(*part, "world");
         part = part->Parent()->ToElement()) {
        const std::string name = own_name(*part);
        if (!name.empty()) path.insert(0, path.empty() ? name : name + "::");
    }
    return path;
}

}  // namespace scipd::sim
