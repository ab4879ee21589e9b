// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include <tinyxml2.h>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/sdf/line_for_line.h"
#include "sim/loaders/sdf/model_folder.h"
#include "sim/loaders/sdf/sdf_cost.h"
#include "sim/loaders/sdf/sdf_document.h"
#include "sim/loaders/sdf/sdf_ignored.h"
#include "sim/loaders/sdf/sdf_kind.h"
#include "sim/loaders/sdf/sdf_library.h"
#include "sim/loaders/sdf/sdf_names.h"
#include "sim/loaders/sdf/wanted_meshes.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// The largest file, as a share of the memory limit: 64 MiB for a world's limit. Once parsed, a
/// file takes up to 50 times its size.
constexpr double largest_part = 1.0 / 64;
constexpr std::size_t deepest_include = 32;

class Surveyor {
  public:
    Surveyor(const Resources& resources, const SdfOptions& options)
        : resources_(resources),
          geometry_(options.geometry),
          most_bytes_(static_cast<double>(options.most_memory_bytes)),
          strict_(options.strict) {}

    SdfSurvey run(const SdfSource& source) {
        try {
            (void)add_document(source.file, source.text ? *source.text : read(source.file));
        } catch (const LoadError& error) {
            survey_.faults.push_back(error.what());
        }
        if (bytes_ > most_bytes_ && survey_.faults.empty()) add_too_large(source.file);
        survey_.bytes = bytes_;
        return std::move(survey_);
    }

  private:
    /// What is known about a file that was read.
    struct Known {
        std::size_t document;
        double bytes;  ///< with all that it includes
    };

    /// Why a file must not be read; empty if it may.
    [[nodiscard]] std::string why_not_enter(const fs::path& file) const {
        std::error_code error;
        const bool loops = std::ranges::find(open_, file) != open_.end();
        if (loops) {
            return std::string{"includes itself"} +
                   (open_.back() == file ? "" : ", through others");
        }
        if (open_.size() >= deepest_include) {
            return "includes are nested more than " + std::to_string(deepest_include) + " deep";
        }
        if (largest_file_bytes() < static_cast<double>(fs::file_size(file, error)) && !error) {
            return file.string() + ": is larger than " +
                   std::to_string(std::lround(largest_file_bytes() / 1048576)) + " MiB";
        }
        return {};
    }

    [[nodiscard]] double largest_file_bytes() const { return most_bytes_ * largest_part; }

    [[nodiscard]] std::string read(const fs::path& file) const {
        now_doing("looking into " + file.string());
        return read_text(file, static_cast<std::uintmax_t>(largest_file_bytes()),
                         "an SDF or URDF file is wanted here");
    }

    /// Returns the index of the new document. Throws LoadError if it is neither SDF nor URDF.
    std::size_t add_document(const fs::path& file, const std::string& text) {
        tinyxml2::XMLDocument document;
        document.Parse(text.c_str());
        if (const auto why = why_no_sdf(text, document); !why.empty()) {
            throw LoadError({file.string() + why});
        }
        const std::size_t place = survey_.documents.size();
        survey_.documents.push_back({file, text});
        auto& root = *document.RootElement();
        const bool is_robot = root.Name() == std::string_view{"robot"};
        if (is_robot) {
            bytes_ += bytes_for_robot(root);
            add_meshes(root, file);
        } else {
            add_sdf(root, place);
            survey_.documents[place].text = line_for_line(document);
        }
        auto* model = is_robot ? &root : root.FirstChildElement("model");
        survey_.documents[place].model = model == nullptr ? "" : own_name(*model);
        survey_.order.push_back(place);
        return place;
    }

    void add_sdf(tinyxml2::XMLElement& root, std::size_t place) {
        const fs::path file = survey_.documents[place].file;
        open_.push_back(file);
        const bool holds_anything = holds_thing(root);
        auto* world = root.FirstChildElement("world");
        if (world != nullptr && place == 0) {
            survey_.state = take_state(*world, file, survey_.warnings);
        }
        add_warnings(take_unreadable(root, file));
        put_in_its_words(root);
        add_warnings(take_actors(root, file, survey_.actors));
        add_warnings(offer_sensors(root, file, survey_.sensors));
        add_warnings(lower_version(root, file));
        if (!strict_) {
            add_warnings(faults_of_ignored(root, file));
            add_warnings(relieve(root, file));
        }
        survey(root, file);
        add_meshes(root, file);
        if (!strict_) {
            drop_empty_models(root);
            add_warnings(mend_names(root, file, [&](const tinyxml2::XMLElement& include) {
                return model_in(include);
            }));
        }
        open_.pop_back();
        survey_.documents[place].is_relieved_of_all = holds_anything && !holds_thing(root);
    }

    void add_warnings(std::vector<std::string> warnings) {
        std::ranges::move(warnings, std::back_inserter(survey_.warnings));
    }

    void add_meshes(const tinyxml2::XMLElement& root, const fs::path& file) {
        // A text has only a name, not a folder.
        const auto folder = file.is_absolute() ? file.parent_path() : resources_.folder();
        std::ranges::move(wanted_meshes(root, folder, resources_, geometry_),
                          std::back_inserter(survey_.meshes));
    }

    /// The name of the model that an include brings, if its document was read; empty if not.
    [[nodiscard]] std::string model_in(const tinyxml2::XMLElement& include) const {
        const auto* uri = include.FirstChildElement("uri");
        const std::string text{trimmed(text_of(uri))};
        for (std::size_t i = 0; i < survey_.documents.size(); ++i) {
            if (text == uri_of(i)) return survey_.documents[i].model;
        }
        return {};
    }

    /// Whether the document has anything that can be included.
    static bool holds_thing(const tinyxml2::XMLElement& root) {
        constexpr std::array things{"model", "actor", "light"};
        return std::ranges::any_of(
            things, [&](const char* name) { return root.FirstChildElement(name) != nullptr; });
    }

    void survey(tinyxml2::XMLElement& element, const fs::path& file) {
        bytes_ += bytes_for(element.Name());
        // The library copies the contents of a plugin without reading them.
        const bool opaque = element.Name() == std::string_view{"plugin"};
        for (auto* child = element.FirstChildElement(); child != nullptr;) {
            auto* next = child->NextSiblingElement();
            if (opaque) {
                bytes_ += bytes_for("");
            } else if (child->Name() == std::string_view{"include"} && !add_include(*child, file)) {
                element.DeleteChild(child);
            } else {
                survey(*child, file);
            }
            child = next;
        }
    }

    /// False if the include must be taken out.
    bool add_include(tinyxml2::XMLElement& include, const fs::path& file) {
        auto* element = include.FirstChildElement("uri");
        if (element == nullptr) return true;  // the library reports it
        const std::string uri{trimmed(text_of(element))};
        const std::string place = file.string() + ':' + std::to_string(include.GetLineNum()) + ": ";
        const auto folder = open_.size() > 1 ? file.parent_path() : resources_.folder();
        const fs::path found = resources_.find(uri, folder).lexically_normal();
        if (found.empty()) return leave_out_missing(uri, folder, place);
        const auto model = model_of(uri, found, place);
        if (!model) return false;
        const auto document = document_of(*model, place);
        // Nothing for a scanner: a lamp, for example.
        if (!document || survey_.documents[*document].is_relieved_of_all) return false;
        element->SetText(uri_of(*document).c_str());
        return true;
    }

    /// The file of the model in `found`; nothing if it has none that can be read.
    std::optional<fs::path> model_of(const std::string& uri, const fs::path& found,
                                     const std::string& place) {
        try {
            std::vector<std::string> notes{case_warning(uri, found)};
            fs::path model = model_file_of(found, notes);
            const auto readable = check_model(found, model);
            for (const auto& note : notes) {
                if (!note.empty()) survey_.warnings.push_back(place + note);
            }
            if (readable) return model;
            leave_out(place + quote(uri, whole_path) + ' ' + readable.error().why);
        } catch (const LoadError& error) {
            leave_out(place + error.what());
        }
        return std::nullopt;
    }

    /// A missing download is reported only once.
    bool leave_out_missing(const std::string& uri, const fs::path& folder,
                           const std::string& place) {
        const auto command = download_command(uri);
        if (!command.empty() && !told_.insert(command).second) return false;
        return leave_out(place + resources_.not_found(uri, folder));
    }

    bool leave_out(const std::string& why) {
        auto& list = strict_ ? survey_.faults : survey_.warnings;
        if (list.size() < most_faults) list.push_back(strict_ ? why : why + "; left out");
        return false;
    }

    std::optional<std::size_t> document_of(const fs::path& file, const std::string& place) {
        if (const auto why = why_not_enter(file); !why.empty()) {
            leave_out(place + why);
            return {};
        }
        // Each include is a copy, and takes memory again, but is not read again.
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
        survey_.faults.push_back(
            file.string() + ": would take about " + megabytes(bytes_) +
            " to read with all its includes, at most " + megabytes(most_bytes_) +
            " is allowed; put parts that never move into one link or one mesh, or allow more by "
            "world_memory_mb under limits in the configuration");
    }

    static constexpr std::size_t most_faults = 1000;

    const Resources& resources_;
    SdfGeometry geometry_;
    double most_bytes_;
    bool strict_;
    SdfSurvey survey_;
    std::vector<fs::path> open_;  ///< the file being read, after those that include it
    std::map<fs::path, Known> known_;
    std::set<std::string> told_;  ///< missing downloads, by command
    double bytes_ = 0.0;
};

}  // namespace

SdfSurvey survey_sdf(const SdfSource& source, const Resources& resources,
                     const SdfOptions& options) {
    return Surveyor{resources, options}.run(source);
}

}  // namespace scipd::sim
