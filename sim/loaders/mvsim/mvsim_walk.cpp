// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mvsim/mvsim_walk.h"

#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <tinyxml2.h>

#include "sim/loaders/file/allowed_folder.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/xml_text.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

constexpr int deepest_block = 64;
constexpr int most_elements = 200'000;
constexpr std::size_t most_files = 1000;

class Walk {
  public:
    explicit Walk(const MvsimVisitor& visitor) : visitor_(visitor) {}

    /// Throws std::invalid_argument.
    const XMLElement& open(std::string text, const fs::path& file) {
        blank_comments(text);
        XMLDocument& document = *documents_.emplace_back(std::make_unique<XMLDocument>());
        const bool parsed = document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS;
        if (parsed && document.RootElement() != nullptr) return *document.RootElement();
        throw std::invalid_argument(file.string() + ':' + std::to_string(document.ErrorLineNum()) +
                                    ": is no XML that can be read");
    }

    void children(const XMLElement& parent, const fs::path& file) {
        if (++depth_ > deepest_block) {
            throw LoadError({file.string() + ':' + std::to_string(parent.GetLineNum()) +
                             ": includes and loops nest deeper than " +
                             std::to_string(deepest_block) + "; do they go in circles?"});
        }
        for (const auto* at = parent.FirstChildElement(); at != nullptr;
             at = at->NextSiblingElement()) {
            element(*at, file);
        }
        --depth_;
    }

  private:
    void element(const XMLElement& at, const fs::path& file) {
        const std::string place = file.string() + ':' + std::to_string(at.GetLineNum());
        count(place);
        try {
            follow(at, file);
        } catch (const std::invalid_argument& wrong) {
            visitor_.leave_out(place + ": <" + printable(at.Name()) + "> " + wrong.what());
        }
    }

    void count(const std::string& place) {
        if (++elements_ <= most_elements) return;
        throw LoadError({place + ": its loops make more than 200000 elements"});
    }

    void follow(const XMLElement& at, const fs::path& file) {
        const std::string_view kind = at.Name();
        const MvsimNode node{at, class_of(at), file, variables_};
        if (kind == "variable") {
            variables_[node.attribute("name")] = node.attribute("value");
        } else if (kind == "for") {
            loop(at, node, file);
        } else if (kind == "if") {
            const std::string condition = node.attribute("condition");
            const bool holds = condition == "true" ||
                               (condition != "false" && formula(condition, variables_) != 0);
            if (holds) children(at, file);
        } else if (kind == "include") {
            include(at, node);
        } else if (kind == "block:class") {
            const char* name = at.Attribute("name");
            if (name != nullptr) classes_[name] = &at;
        } else if (kind == "mvsim_world") {
            children(at, file);
        } else {
            visitor_.visit(node);
        }
    }

    void loop(const XMLElement& at, const MvsimNode& node, const fs::path& file) {
        const double from = formula(node.attribute("from"), variables_);
        const double to = formula(node.attribute("to"), variables_);
        if (!(to - from <= most_elements)) throw std::invalid_argument("runs too often");
        const std::string name = node.attribute("var");
        for (double i = std::trunc(from); i <= std::trunc(to); ++i) {
            variables_[name] = std::to_string(std::llround(i));
            count(node.place());
            children(at, file);
        }
    }

    /// The other attributes of the element are variables inside the included file.
    void include(const XMLElement& at, const MvsimNode& node) {
        const fs::path& file =
            files_.emplace_back(node.beside(node.attribute("file")).lexically_normal());
        const std::string named = printable(file.string(), whole_path);
        if (files_.size() > most_files) throw LoadError({named + ": is one file too many"});
        const auto text = visitor_.read(file);
        if (!text) {
            throw std::invalid_argument("names " + printable(file.string()) +
                                        ", which is not there" + or_in_no_folder());
        }
        const XMLElement& root = open(*text, file);
        Variables within = variables_;
        for (const auto* given = at.FirstAttribute(); given != nullptr; given = given->Next()) {
            if (std::string_view(given->Name()) != "file")
                within[given->Name()] = node.attribute(given->Name());
        }
        std::swap(variables_, within);
        if (++depth_ > deepest_block) throw LoadError({named + ": includes itself"});
        element(root, file);
        --depth_;
        variables_ = std::move(within);
    }

    const XMLElement* class_of(const XMLElement& at) const {
        const char* name = at.Attribute("class");
        const auto known = name == nullptr ? classes_.end() : classes_.find(name);
        return known == classes_.end() ? nullptr : known->second;
    }

    const MvsimVisitor& visitor_;
    std::deque<std::unique_ptr<XMLDocument>> documents_;
    std::deque<fs::path> files_;
    std::map<std::string, const XMLElement*, std::less<>> classes_;
    Variables variables_;
    int depth_ = 0;
    int elements_ = 0;
};

}  // namespace

void walk_mvsim(const std::string& text, const fs::path& file, const MvsimVisitor& visitor) {
    Walk walk{visitor};
    const XMLElement* root = nullptr;
    try {
        root = &walk.open(text, file);
    } catch (const std::invalid_argument& wrong) {
        throw LoadError({wrong.what()});
    }
    if (std::string_view(root->Name()) != "mvsim_world") {
        throw LoadError({file.string() + ": is no world of MVSim: its root is <" +
                         printable(root->Name()) + ">, not <mvsim_world>"});
    }
    walk.children(*root, file);
}

}  // namespace scipd::sim
