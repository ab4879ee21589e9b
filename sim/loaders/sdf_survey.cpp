// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/model_folder.h"
#include "sim/loaders/plain_file.h"
#include "sim/loaders/quote.h"

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
constexpr std::array costs{Cost{"model", 1.4e6},     Cost{"link", 0.85e6},  Cost{"actor", 1e6},
                           Cost{"joint", 0.6e6},     Cost{"sensor", 0.6e6}, Cost{"visual", 0.17e6},
                           Cost{"collision", 0.17e6}};
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

class Surveyor {
  public:
    Surveyor(const Resources& resources, double most_bytes)
        : resources_(resources), most_bytes_(most_bytes) {}

    SdfSurvey run(const SdfSource& source) {
        if (!source.text) {
            survey_file(source.file);
        } else if (tinyxml2::XMLDocument document;
                   document.Parse(source.text->c_str()) == tinyxml2::XML_SUCCESS) {
            open_ = {source.file};
            survey_root(document, source.file);
        }
        if (bytes_ > most_bytes_ && survey_.faults.empty()) add_too_large(source.file);
        return std::move(survey_);
    }

  private:
    /// False where it need not be looked into.
    bool enter(const fs::path& file, const std::string& place) {
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

    void survey_file(const fs::path& file, const std::string& place = {}) {
        if (!enter(file, place)) return;
        // Again for each include of it, since each is a copy; known ones cost no time.
        if (const auto known = bytes_of_.find(file); known != bytes_of_.end()) {
            bytes_ += known->second;
            return;
        }
        const double before = bytes_;
        open_.push_back(file);
        tinyxml2::XMLDocument document;
        if (document.LoadFile(file.c_str()) == tinyxml2::XML_SUCCESS) {
            survey_root(document, file);
        }
        open_.pop_back();
        bytes_of_[file] = bytes_ - before;
    }

    /// A document of comments alone has none.
    void survey_root(const tinyxml2::XMLDocument& document, const fs::path& file) {
        if (const auto* root = document.RootElement()) survey(*root, file);
    }

    void survey(const tinyxml2::XMLElement& element, const fs::path& file) {
        bytes_ += cost_of(element.Name());
        if (element.Name() == std::string_view{"include"}) add_include(element, file);
        // The library copies what is in there and does not look at it.
        const bool opaque = element.Name() == std::string_view{"plugin"};
        for (auto* child = element.FirstChildElement(); child != nullptr;
             child = child->NextSiblingElement()) {
            if (opaque) {
                bytes_ += other_element_bytes;
            } else {
                survey(*child, file);
            }
        }
    }

    void add_include(const tinyxml2::XMLElement& include, const fs::path& file) {
        const auto* element = include.FirstChildElement("uri");
        if (element == nullptr || survey_.faults.size() >= most_faults) return;
        const std::string uri = trimmed(element->GetText());
        const std::string place = file.string() + ':' + std::to_string(include.GetLineNum()) + ": ";
        auto known = survey_.includes.find(uri);
        if (known == survey_.includes.end()) {
            const auto folder = open_.size() > 1 ? file.parent_path() : resources_.folder();
            const fs::path found = resources_.find(uri, folder);
            if (found.empty()) {
                survey_.faults.push_back(place + resources_.not_found(uri, folder));
                return;
            }
            known = survey_.includes.emplace(uri, found.lexically_normal()).first;
        }
        const fs::path model = model_file_of(known->second);
        if (const auto why = why_no_model(known->second, model); !why.empty()) {
            survey_.faults.push_back(place + quote(uri) + why);
            return;
        }
        survey_file(model, place);
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
    SdfSurvey survey_;
    std::vector<fs::path> open_;  ///< the file that is looked at, and those that include it
    std::map<fs::path, double> bytes_of_;
    double bytes_ = 0.0;
};

}  // namespace

SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     std::size_t most_memory_bytes) {
    return Surveyor{resources, static_cast<double>(most_memory_bytes)}.run(source);
}

}  // namespace scipd::sim
