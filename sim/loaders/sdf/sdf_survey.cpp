// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/load_error.h"
#include "sim/loaders/plain_file.h"
#include "sim/loaders/quote.h"
#include "sim/loaders/sdf/model_folder.h"
#include "sim/loaders/sdf/sdf_document.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// A file may have this part of the memory in bytes, 64 MiB of a world's: parsed, it takes up to 50
/// times that.
constexpr double largest_part = 1.0 / 64;
constexpr std::size_t deepest_include = 32;

/// What libsdformat 12.3 takes for an element and its parts, measured on files of a thousand of
/// them.
struct Cost {
    std::string_view element;
    double bytes;
};
constexpr std::array costs{Cost{"model", 1.4e6},      Cost{"link", 0.85e6},  Cost{"actor", 1e6},
                           Cost{"joint", 0.6e6},      Cost{"sensor", 0.6e6}, Cost{"visual", 0.17e6},
                           Cost{"collision", 0.17e6}, Cost{"frame", 12e3}};
constexpr double other_element_bytes = 2e3;

double cost_of(std::string_view element) {
    const auto known = std::ranges::find(costs, element, &Cost::element);
    return known == costs.end() ? other_element_bytes : known->bytes;
}

/// Empty where `model`, the file that the library has for what an include names, can be read.
std::string why_no_model(const fs::path& found, const fs::path& model) {
    const auto why = why_no_file(model);
    std::error_code error;
    if (why.empty() || !fs::is_directory(found, error)) return why.empty() ? why : ' ' + why;
    return " is the folder " + found.string() +
           ", which has no model.config that names an SDF file";
}

std::string trimmed(const char* text) {
    std::string_view all = text == nullptr ? "" : text;
    constexpr std::string_view blank = " \t\r\n";
    all.remove_prefix(std::min(all.find_first_not_of(blank), all.size()));
    return std::string{all.substr(0, all.find_last_not_of(blank) + 1)};
}

/// In the words of the library that found it, less its prefix.
std::string broken_xml(const tinyxml2::XMLDocument& document) {
    std::string_view name = document.ErrorName();
    for (const std::string_view prefix : {"XML_", "ERROR_"}) {
        if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
    }
    const int line = std::max(document.ErrorLineNum(), 1);
    return ':' + std::to_string(line) + ": is no XML that can be read: " + std::string{name};
}

class Surveyor {
  public:
    Surveyor(const Resources& resources, double most_bytes, bool strict)
        : resources_(resources), most_bytes_(most_bytes), strict_(strict) {}

    SdfSurvey run(const SdfSource& source) {
        try {
            if (source.text || may_enter(source.file, "")) {
                (void)add_document(source.file, source.text ? *source.text : read(source.file));
            }
        } catch (const LoadError& error) {
            survey_.faults.push_back(error.what());
        }
        if (bytes_ > most_bytes_ && survey_.faults.empty()) add_too_large(source.file);
        return std::move(survey_);
    }

  private:
    /// What is known of a file that was looked at.
    struct Known {
        std::size_t document;
        double bytes;  ///< with all that it includes
    };

    /// False where it is not to be looked into.
    bool may_enter(const fs::path& file, const std::string& place) {
        std::error_code error;
        const bool loops = std::ranges::find(open_, file) != open_.end();
        if (loops) {
            survey_.faults.push_back(place + "includes itself" +
                                     (open_.back() == file ? "" : ", through others"));
        } else if (open_.size() >= deepest_include) {
            survey_.faults.push_back(place + "includes lie more than " +
                                     std::to_string(deepest_include) + " deep");
        } else if (largest_file_bytes() < static_cast<double>(fs::file_size(file, error)) &&
                   !error) {
            survey_.faults.push_back(file.string() + ": is larger than " +
                                     std::to_string(std::lround(largest_file_bytes() / 1048576)) +
                                     " MiB");
        } else {
            return true;
        }
        return false;
    }

    [[nodiscard]] double largest_file_bytes() const { return most_bytes_ * largest_part; }

    [[nodiscard]] std::string read(const fs::path& file) const {
        return read_file(file, static_cast<std::uintmax_t>(largest_file_bytes()),
                         "an SDF or URDF file is wanted here");
    }

    /// Its place among the documents. Throws LoadError where it is no XML.
    std::size_t add_document(const fs::path& file, const std::string& text) {
        tinyxml2::XMLDocument document;
        if (document.Parse(text.c_str()) != tinyxml2::XML_SUCCESS) {
            throw LoadError({file.string() + broken_xml(document)});
        }
        const std::size_t place = survey_.documents.size();
        survey_.documents.push_back({file, text});
        auto* root = document.RootElement();
        if (root == nullptr || root->Name() == std::string_view{"robot"}) {
            bytes_ += robot_bytes(root);
            return place;
        }
        open_.push_back(file);
        const bool holds_anything = holds_thing(*root);
        std::ranges::move(take_unreadable(*root, file), std::back_inserter(survey_.warnings));
        std::ranges::move(offer_sensors(*root, file, survey_.sensors),
                          std::back_inserter(survey_.warnings));
        lower_version(*root);
        if (!strict_) relieve(*root);
        survey(*root, file);
        open_.pop_back();
        SdfDocument& ready = survey_.documents[place];
        ready.text = line_for_line(document);
        ready.is_relieved_of_all = holds_anything && !holds_thing(*root);
        return place;
    }

    /// What an include may be of.
    static bool holds_thing(const tinyxml2::XMLElement& root) {
        constexpr std::array things{"model", "actor", "light"};
        return std::ranges::any_of(
            things, [&](const char* name) { return root.FirstChildElement(name) != nullptr; });
    }

    /// Its links become links.
    static double robot_bytes(const tinyxml2::XMLElement* element) {
        double bytes = 0.0;
        for (; element != nullptr; element = element->NextSiblingElement())
            bytes += cost_of(element->Name()) + robot_bytes(element->FirstChildElement());
        return bytes;
    }

    void survey(tinyxml2::XMLElement& element, const fs::path& file) {
        bytes_ += cost_of(element.Name());
        // The library copies what is in there and does not look at it.
        const bool opaque = element.Name() == std::string_view{"plugin"};
        for (auto* child = element.FirstChildElement(); child != nullptr;) {
            auto* next = child->NextSiblingElement();
            if (opaque) {
                bytes_ += other_element_bytes;
            } else if (child->Name() == std::string_view{"include"} && !add_include(*child, file)) {
                element.DeleteChild(child);
            } else {
                survey(*child, file);
            }
            child = next;
        }
    }

    /// False where there is nothing to include.
    bool add_include(tinyxml2::XMLElement& include, const fs::path& file) {
        auto* element = include.FirstChildElement("uri");
        if (element == nullptr) return true;  // the library has words for it
        const std::string uri = trimmed(element->GetText());
        const std::string place = file.string() + ':' + std::to_string(include.GetLineNum()) + ": ";
        const auto folder = open_.size() > 1 ? file.parent_path() : resources_.folder();
        const fs::path found = resources_.find(uri, folder).lexically_normal();
        if (found.empty()) return leave_out(place + resources_.not_found(uri, folder));
        const fs::path model = model_file_of(found);
        const auto why = why_no_model(found, model);
        if (!why.empty()) return leave_out(place + quote(uri) + why);
        const auto document = document_of(model, place);
        // A lamp, say.
        if (!document || survey_.documents[*document].is_relieved_of_all) return false;
        element->SetText(uri_of(*document).c_str());
        return true;
    }

    bool leave_out(const std::string& why) {
        auto& list = strict_ ? survey_.faults : survey_.warnings;
        if (list.size() < most_faults) list.push_back(strict_ ? why : why + "; left out");
        return false;
    }

    std::optional<std::size_t> document_of(const fs::path& file, const std::string& place) {
        if (!may_enter(file, place)) return {};
        // Again for each include of it, since each is a copy; known ones cost no time.
        if (const auto known = known_.find(file); known != known_.end()) {
            bytes_ += known->second.bytes;
            return known->second.document;
        }
        const double before = bytes_;
        try {
            const std::size_t document = add_document(file, read(file));
            known_[file] = {document, bytes_ - before};
            return document;
        } catch (const LoadError& error) {
            leave_out(error.what());
            return {};
        }
    }

    void add_too_large(const fs::path& file) {
        const auto megabytes = [](double bytes) {
            return std::to_string(static_cast<long>(std::min(1e15, std::ceil(bytes / 1e6)))) +
                   " MB";
        };
        survey_.faults.push_back(
            file.string() + ": would take about " + megabytes(bytes_) +
            " to read with all its includes, at most " + megabytes(most_bytes_) +
            " is allowed; put parts that never move into one link or one mesh");
    }

    static constexpr std::size_t most_faults = 1000;

    const Resources& resources_;
    double most_bytes_;
    bool strict_;
    SdfSurvey survey_;
    std::vector<fs::path> open_;  ///< the file that is looked at, and those that include it
    std::map<fs::path, Known> known_;
    double bytes_ = 0.0;
};

}  // namespace

std::string uri_of(std::size_t document) {
    return "scipd://" + std::to_string(document);
}

SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     std::size_t most_memory_bytes, bool strict) {
    return Surveyor{resources, static_cast<double>(most_memory_bytes), strict}.run(source);
}

}  // namespace scipd::sim
