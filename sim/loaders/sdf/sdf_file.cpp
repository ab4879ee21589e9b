// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_file.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <sdf/Element.hh>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/sdf/sdf_console.h"
#include "sim/loaders/sdf/sdf_library.h"
#include "sim/loaders/sdf/sdf_printed.h"
#include "sim/loaders/sdf/sdf_repair.h"
#include "sim/loaders/sdf/urdf.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// The names that libsdformat gives to a text, in elements and in messages.
constexpr std::array text_names{"", "<data-string>", "data-string"};

StandIn stand_in_for(const SdfDocument& document) {
    if (!document.is_converted) return {document.file, true};
    return {document.file, false, document.robot, lines_of_links(document.robot)};
}

class Reader {
  public:
    Reader(SdfSurvey survey, const SdfOptions& options, SdfFile& result)
        : documents_(std::move(survey.documents)),
          order_(std::move(survey.order)),
          options_(options),
          result_(result) {}

    void read() {
        for (std::size_t i = 0; i < documents_.size(); ++i)
            convert(i);
        if (!result_.faults.empty()) return;
        sdf::Errors errors = load(documents_.front().text);
        if (!errors.empty() && !options_.strict) errors = mend();
        for (const char* name : text_names)
            result_.stand_ins[name] = stand_in_for(documents_.front());
        add_printed(options_.strict || !errors.empty());
        add_errors(errors);
    }

  private:
    /// More rounds than real files need. Each round reads the document once more.
    static constexpr int most_rounds = 100;

    /// Converts a robot to SDF.
    void convert(std::size_t document) {
        if (is_urdf(documents_[document].text)) {
            std::vector<std::string> faults;
            SdfDocument& robot = documents_[document];
            robot.robot = std::exchange(robot.text, converted(robot, faults));
            robot.is_converted = true;
            if (!faults.empty() && (document == 0 || options_.strict)) {
                std::ranges::move(faults, std::back_inserter(result_.faults));
            } else if (!faults.empty()) {
                leave_out(document, faults.front());
            }
        }
        if (document > 0) write(document);
    }

    /// Writes the text as a file, since the library includes only files.
    void write(std::size_t document) {
        const SdfDocument& from = documents_[document];
        result_.stand_ins[library_.write(uri_of(document), from.text)] = stand_in_for(from);
    }

    sdf::Errors load(const std::string& text) {
        (void)console_.take();
        return library_.load(text, result_.root);
    }

    /// Takes out what the library refuses. Included documents come first, because the library gives
    /// no place for an error in them. Returns the errors that remain.
    sdf::Errors mend() {
        sdf::Errors errors;
        for (const std::size_t document : order_) {
            errors = mend(document);
            if (document == 0) break;
            if (!errors.empty()) {
                leave_out(document, describe(without_echoes(errors).front(), document));
            }
            write(document);
        }
        return errors;
    }

    sdf::Errors mend(std::size_t document) {
        SdfDocument& mended = documents_[document];
        mend_values(mended);
        sdf::Errors errors = load(mended.text);
        for (int round = 0; round < most_rounds && !errors.empty(); ++round) {
            auto warnings = take_out(errors, mended);
            if (warnings.empty()) {
                warnings = take_out_models(mended, [&](const auto& text) {
                    const auto found = load(text);
                    return found.empty() ? "" : without_echoes(found).front().Message();
                });
            }
            if (warnings.empty()) break;
            std::ranges::move(warnings, std::back_inserter(result_.warnings));
            errors = load(mended.text);
        }
        return errors;
    }

    /// The library reports unreadable values first, and only one at a time. Everything before such
    /// a value is right, so the next round reads only what follows it.
    void mend_values(SdfDocument& document) {
        SdfDocument rest = document;
        for (int round = 0; round < 10 * most_rounds; ++round) {
            sdf::Errors errors = load(rest.text);
            std::erase_if(errors, [](const auto& error) { return !error.XmlPath(); });
            if (errors.empty()) return;
            drop_read(errors.front(), rest);
            if (take_out(errors, rest).empty()) return;
            std::ranges::move(take_out(errors, document), std::back_inserter(result_.warnings));
        }
    }

    void leave_out(std::size_t document, const std::string& why) {
        result_.warnings.push_back(why + "; left out, no scanner sees it");
        for (SdfDocument& other : documents_)
            take_out_includes(other, uri_of(document));
    }

    std::string converted(const SdfDocument& robot, std::vector<std::string>& faults) {
        const fs::path& file = robot.file;
        std::string text =
            sdf_from_urdf(robot.text, file, options_, result_.sensors, result_.warnings);
        const auto said = console_.take();
        for (const auto& fault : said.faults) {
            if (is_printed_echo(fault)) continue;
            const int line = line_in_urdf(robot.text, fault);
            faults.push_back(file.string() + (line > 0 ? ':' + std::to_string(line) : "") + ": " +
                             fault);
        }
        for (const auto& warning : said.warnings)
            result_.warnings.push_back(file.string() + ": " + warning);
        if (text.empty() && said.faults.empty()) {
            faults.push_back(file.string() + ": is no robot that libsdformat can read");
        }
        return text;
    }

    /// Errors that are only printed are warnings if the load succeeds.
    void add_printed(bool as_faults) {
        auto said = console_.take();
        std::erase_if(said.faults, is_printed_echo);
        const auto add = [&](const std::vector<std::string>& printed,
                             std::vector<std::string>& list) {
            std::ranges::move(in_plain_words(printed, result_.stand_ins, documents_.front().file),
                              std::back_inserter(list));
        };
        add(said.faults, as_faults ? result_.faults : result_.warnings);
        add(said.warnings, result_.warnings);
    }

    void add_errors(const sdf::Errors& errors) {
        for (const auto& error : without_echoes(errors))
            add_fault(describe(error, 0));
    }

    void add_fault(std::string text) {
        auto& all = result_.faults;
        if (std::ranges::find(all, text) == all.end()) all.push_back(std::move(text));
    }

    /// The text of an error in this document or in one that it includes.
    [[nodiscard]] std::string describe(const sdf::Error& error, std::size_t document) const {
        const auto path = error.FilePath().value_or("");
        const auto real = result_.stand_ins.find(path);
        std::string text = real == result_.stand_ins.end() ? documents_[document].file.string()
                                                           : real->second.file.string();
        if (error.LineNumber()) text += ':' + std::to_string(*error.LineNumber());
        text += ": " + error.Message();
        if (error.XmlPath()) text += " (" + *error.XmlPath() + ")";
        return text;
    }

    std::vector<SdfDocument> documents_;
    std::vector<std::size_t> order_;
    const SdfOptions& options_;
    SdfFile& result_;
    SdfConsole console_;
    SdfLibrary library_;
};

}  // namespace

fs::path SdfFile::file_of(const sdf::ElementPtr& element, const fs::path& otherwise) const {
    if (!element) return otherwise;
    const auto real = stand_ins.find(element->FilePath());
    return real == stand_ins.end() ? fs::path{element->FilePath()} : real->second.file;
}

std::string SdfFile::place_of(const sdf::ElementPtr& element, const fs::path& otherwise) const {
    const std::string file = file_of(element, otherwise).string();
    const auto stand_in = element ? stand_ins.find(element->FilePath()) : stand_ins.end();
    if (stand_in == stand_ins.end()) return file;
    if (stand_in->second.same_lines) {
        const auto line = element->LineNumber();
        return line ? file + ':' + std::to_string(*line) : file;
    }
    for (auto at = element; at; at = at->GetParent()) {
        if (at->GetName() != "link") continue;
        const auto line = stand_in->second.lines.find(at->Get<std::string>("name"));
        if (line != stand_in->second.lines.end()) return file + ':' + std::to_string(line->second);
    }
    return file;
}

std::string SdfFile::uri_as_written(const sdf::ElementPtr& element, const std::string& uri) const {
    constexpr std::string_view model = "model://";
    const auto stand_in = element ? stand_ins.find(element->FilePath()) : stand_ins.end();
    if (stand_in == stand_ins.end() || !uri.starts_with(model)) return uri;
    std::string package = "package://" + uri.substr(model.size());
    return stand_in->second.robot.find(package) == std::string::npos ? uri : package;
}

SdfFile read_sdf(SdfSurvey survey, const SdfOptions& options) {
    SdfFile result;
    result.faults = std::move(survey.faults);
    result.warnings = std::move(survey.warnings);
    result.actors = std::move(survey.actors);
    result.state = std::move(survey.state);
    result.sensors = std::move(survey.sensors);
    if (result.faults.empty()) Reader{std::move(survey), options, result}.read();
    return result;
}

}  // namespace scipd::sim
