// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/urdf_tree.h"

#include <algorithm>
#include <map>
#include <set>

#include <tinyxml2.h>

#include "sim/loaders/file/xml_tree.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t longest_urdf_text = 200;

std::string link_of(const XMLElement& joint, const char* end) {
    const auto* named = joint.FirstChildElement(end);
    return named == nullptr ? "" : attribute(*named, "link");
}

class Tree {
  public:
    Tree(XMLElement& robot, const std::filesystem::path& file) : robot_(robot), file_(file) {}

    std::vector<std::string> mend() && {
        delete_children(robot_, [this](XMLElement& part) {
            return is_one_of(part, {"link"}) && is_left_out(part, fault_of_link(part));
        });
        delete_children(robot_, [this](XMLElement& part) {
            if (!is_one_of(part, {"joint"})) return false;
            if (is_left_out(part, fault_of_joint(part))) return true;
            parent_of_[link_of(part, "child")] = link_of(part, "parent");
            name_joint(part);
            mend_origin(part);
            return false;
        });
        join_roots();
        return std::move(warnings_);
    }

  private:
    void warn(const XMLElement& part, const std::string& what) {
        const std::string name = attribute(part, "name");
        warnings_.push_back(file_.string() + ':' + std::to_string(part.GetLineNum()) + ": " +
                            part.Name() + (name.empty() ? "" : ' ' + shown(name)) + ": " + what);
    }

    bool is_left_out(const XMLElement& part, const std::string& fault) {
        if (!fault.empty()) warn(part, fault + "; left out");
        return !fault.empty();
    }

    static std::string shown(const std::string& name) { return printable(name, longest_urdf_text); }

    std::string fault_of_link(const XMLElement& link) {
        const std::string name = attribute(link, "name");
        if (name.empty()) return "has no name";
        return links_.insert(name).second ? "" : "there is another of this name";
    }

    std::string fault_of_joint(const XMLElement& joint) const {
        for (const char* end : {"parent", "child"}) {
            const std::string link = link_of(joint, end);
            if (link.empty()) return std::string{"has no <"} + end + " link='..'>";
            if (!links_.contains(link)) {
                return std::string{"its <"} + end + "> " + shown(link) + " is no link";
            }
        }
        const std::string child = link_of(joint, "child");
        if (parent_of_.contains(child)) return "link " + shown(child) + " hangs on another joint";
        std::string above = link_of(joint, "parent");
        for (auto at = parent_of_.find(above); at != parent_of_.end() && above != child;
             at = parent_of_.find(above)) {
            above = at->second;
        }
        return above == child ? "its parent hangs on its child" : "";
    }

    /// Gives a joint a name of its own, without a warning: nobody asks for joint names.
    void name_joint(XMLElement& joint) {
        std::string name = attribute(joint, "name");
        for (int i = 0; name.empty() || !joints_.insert(name).second; ++i)
            name = link_of(joint, "child") + "_joint_" + std::to_string(i);
        joint.SetAttribute("name", name.c_str());
    }

    void mend_origin(XMLElement& joint) {
        auto* origin = joint.FirstChildElement("origin");
        if (origin == nullptr) return;
        for (const char* part : {"xyz", "rpy"}) {
            const char* text = origin->Attribute(part);
            if (text == nullptr || parse_numbers(text, 3)) continue;
            warn(joint, std::string{"its <origin "} + part + "='" + shown(text) +
                            "'> cannot be read; 0 0 0 is taken");
            origin->DeleteAttribute(part);
        }
    }

    /// Joins all roots to one: to "world", the library's name for what does not move, or else to
    /// the first.
    void join_roots() {
        const auto is_root = [this](const XMLElement& link) {
            return !parent_of_.contains(attribute(link, "name"));
        };
        std::vector<XMLElement*> roots;
        for (auto* link = robot_.FirstChildElement("link"); link != nullptr;
             link = link->NextSiblingElement("link")) {
            if (is_root(*link)) roots.push_back(link);
        }
        const auto world = std::ranges::find_if(
            roots, [](const XMLElement* root) { return attribute(*root, "name") == "world"; });
        if (world != roots.end()) std::rotate(roots.begin(), world, world + 1);
        for (std::size_t i = 1; i < roots.size(); ++i) {
            warn(*roots[i], "hangs on no joint; it stands at the origin of the robot");
            join(*roots.front(), *roots[i]);
        }
    }

    void join(const XMLElement& parent, const XMLElement& child) {
        XMLElement& joint = *robot_.InsertNewChildElement("joint");
        joint.SetAttribute("type", "fixed");
        joint.InsertNewChildElement("parent")->SetAttribute("link",
                                                            attribute(parent, "name").c_str());
        joint.InsertNewChildElement("child")->SetAttribute("link",
                                                           attribute(child, "name").c_str());
        name_joint(joint);
    }

    XMLElement& robot_;
    const std::filesystem::path& file_;
    std::set<std::string> links_;
    std::set<std::string> joints_;
    std::map<std::string, std::string> parent_of_;  ///< the parent link of each link
    std::vector<std::string> warnings_;
};

}  // namespace

std::vector<std::string> mend_tree(XMLElement& robot, const std::filesystem::path& file) {
    return Tree{robot, file}.mend();
}

}  // namespace scipd::sim
