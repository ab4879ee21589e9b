// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include <sdf/Element.hh>
#include <sdf/ParserConfig.hh>

#include "sim/loaders/load_error.h"
#include "sim/loaders/plain_file.h"
#include "sim/loaders/sdf/sdf_console.h"
#include "sim/loaders/sdf/urdf.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// What libsdformat calls a text, in an element and in messages.
constexpr std::array text_names{"", "<data-string>", "data-string"};

/// For what a world includes: the library wants files.
class MemoryFiles {
  public:
    fs::path write(const std::string& text) {
        files_.push_back(memory_file());
        std::FILE* file = files_.back().get();
        std::fwrite(text.data(), 1, text.size(), file);
        std::fflush(file);
        return "/proc/self/fd/" + std::to_string(fileno(file));
    }

  private:
    std::vector<File> files_;
};

/// The global configuration is the only one that the library has for includes within includes.
class GlobalConfig {
  public:
    explicit GlobalConfig(sdf::ParserConfig config)
        : before_(std::exchange(sdf::ParserConfig::GlobalConfig(), std::move(config))) {}
    ~GlobalConfig() { sdf::ParserConfig::GlobalConfig() = std::move(before_); }
    GlobalConfig(const GlobalConfig&) = delete;
    GlobalConfig& operator=(const GlobalConfig&) = delete;

  private:
    sdf::ParserConfig before_;
};

using Includes = std::map<std::string, fs::path>;

sdf::ParserConfig config_for(Includes includes) {
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetFindCallback([includes = std::move(includes)](const std::string& uri) {
        const auto known = includes.find(uri);
        return known == includes.end() ? std::string{} : known->second.string();
    });
    return config;
}

/// What the library adds where it has said what is wrong.
bool is_echo(const std::string& printed) {
    // It takes whatever is no good SDF for a robot.
    return printed.starts_with("Could not find the 'robot' element") ||
           printed.starts_with("Unable to call parseURDF on robot model") ||
           printed.starts_with("parse as old deprecated model file failed");
}

/// One unreadable element makes the library complain once more about every element around it, and
/// one lost frame about the whole graph of frames.
bool is_echo(const sdf::Error& error, const std::string& last_path) {
    const auto message = error.Message();
    if (message.starts_with("Error reading element")) {
        return !last_path.empty() && last_path.starts_with(error.XmlPath().value_or(""));
    }
    return message.starts_with("Unable to read file") ||
           message.starts_with("Unable to read SDF string") ||
           message.starts_with("Failed to load a world") ||
           error.Code() == sdf::ErrorCode::FRAME_ATTACHED_TO_GRAPH_ERROR ||
           error.Code() == sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR;
}

class Reader {
  public:
    Reader(const SdfSource& source, bool strict, SdfFile& result)
        : source_(source), strict_(strict), result_(result) {}

    void read(const std::vector<SdfDocument>& documents) {
        Includes includes;
        for (std::size_t i = 1; i < documents.size(); ++i)
            includes[uri_of(i)] = stand_in_for(documents[i]);
        const SdfDocument& main = documents.front();
        const bool urdf = is_urdf(main.text);
        const std::string text = urdf ? converted(main) : main.text;
        for (const char* name : text_names)
            result_.stand_ins[name] = {main.file, !urdf};
        if (!result_.faults.empty()) return;

        const sdf::ParserConfig config = config_for(std::move(includes));
        const GlobalConfig global{config};
        const sdf::Errors errors = result_.root.LoadSdfString(text, config);
        add_printed();
        add_errors(errors);
    }

  private:
    fs::path stand_in_for(const SdfDocument& document) {
        const bool urdf = is_urdf(document.text);
        const fs::path path = files_.write(urdf ? converted(document) : document.text);
        result_.stand_ins[path] = {document.file, !urdf};
        return path;
    }

    /// What is wrong with the robot becomes faults.
    std::string converted(const SdfDocument& robot) {
        const fs::path& file = robot.file;
        std::string text = sdf_from_urdf(robot, strict_, result_.sensors, result_.warnings);
        const auto said = console_.take();
        for (const auto& fault : said.faults) {
            if (is_echo(fault)) continue;
            const int line = line_in_urdf(robot.text, fault);
            result_.faults.push_back(file.string() + (line > 0 ? ':' + std::to_string(line) : "") +
                                     ": " + fault);
        }
        for (const auto& warning : said.warnings)
            result_.warnings.push_back(file.string() + ": " + warning);
        if (text.empty() && said.faults.empty()) {
            result_.faults.push_back(file.string() + ": is no robot that libsdformat can read");
        }
        return text;
    }

    void add_printed() {
        const auto said = console_.take();
        for (const auto& text : said.faults) {
            if (is_echo(text)) continue;
            result_.faults.push_back(source_.file.string() + ": " + with_real_names(text));
        }
        for (const auto& text : said.warnings)
            result_.warnings.push_back(source_.file.string() + ": " + with_real_names(text));
    }

    /// "<data-string>:L5" is in no file that anybody has.
    [[nodiscard]] std::string with_real_names(std::string text) const {
        for (const auto& [name, real] : result_.stand_ins) {
            const std::string place = name + ":L";
            const auto at = name.empty() ? text.npos : text.find(place);
            if (at != text.npos) text.replace(at, name.size(), real.file.string());
        }
        return text;
    }

    void add_errors(const sdf::Errors& errors) {
        std::string last_path;
        for (const auto& error : errors) {
            if (is_echo(error, last_path)) continue;
            last_path = error.XmlPath().value_or("");
            add_fault(describe(error));
        }
        if (!result_.faults.empty()) return;
        for (const auto& error : errors)
            add_fault(describe(error));
    }

    void add_fault(std::string text) {
        auto& all = result_.faults;
        if (std::ranges::find(all, text) == all.end()) all.push_back(std::move(text));
    }

    [[nodiscard]] std::string describe(const sdf::Error& error) const {
        const auto path = error.FilePath().value_or("");
        const auto real = result_.stand_ins.find(path);
        std::string text = real == result_.stand_ins.end() ? path : real->second.file.string();
        if (error.LineNumber()) text += ':' + std::to_string(*error.LineNumber());
        text += ": " + error.Message();
        if (error.XmlPath()) text += " (" + *error.XmlPath() + ")";
        return text;
    }

    const SdfSource& source_;
    bool strict_;
    SdfFile& result_;
    SdfConsole console_;
    MemoryFiles files_;
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
    if (stand_in == stand_ins.end() || !stand_in->second.same_lines || !element->LineNumber())
        return file;
    return file + ':' + std::to_string(*element->LineNumber());
}

SdfFile read_sdf(const SdfSource& source, const Resources& resources, std::size_t most_memory_bytes,
                 bool strict) {
    SdfFile result;
    Reader reader{source, strict, result};
    auto survey = survey_sdf(source, resources, most_memory_bytes, strict);
    result.faults = std::move(survey.faults);
    result.warnings = std::move(survey.warnings);
    result.sensors = std::move(survey.sensors);
    if (result.faults.empty()) reader.read(survey.documents);
    return result;
}

}  // namespace scipd::sim
