// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

#include <sdf/Element.hh>
#include <sdf/ParserConfig.hh>

#include "sim/loaders/load_error.h"
#include "sim/loaders/model_folder.h"
#include "sim/loaders/sdf_console.h"
#include "sim/loaders/urdf.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// What libsdformat calls a text.
constexpr auto text_path = "data-string";

std::string contents_of(const fs::path& file) {
    std::ifstream stream{file, std::ios::binary};
    return {std::istreambuf_iterator<char>{stream}, {}};
}

/// For robots that a world includes: the library wants files.
class TemporaryFolder {
  public:
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }

    fs::path write(const std::string& text) {
        if (path_.empty()) {
            std::string pattern = fs::temp_directory_path() / "scipd-XXXXXX";
            if (mkdtemp(pattern.data()) == nullptr) {
                throw LoadError({pattern + ": cannot be made; it is for robots in URDF"});
            }
            path_ = pattern;
        }
        const fs::path file = path_ / (std::to_string(count_++) + ".sdf");
        std::ofstream{file, std::ios::binary} << text;
        return file;
    }

  private:
    fs::path path_;
    int count_ = 0;
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

sdf::ParserConfig config_for(const std::map<std::string, fs::path>& includes) {
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::WARN);
    for (const auto& [uri, path] : includes) {
        // Otherwise the library would look first where the program runs.
        const fs::path name = fs::path{uri}.filename();
        if (path.filename() == name) {
            config.AddURIPath(uri.substr(0, uri.size() - name.string().size()),
                              path.parent_path().string());
        }
    }
    config.SetFindCallback([includes](const std::string& uri) {
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
    Reader(const SdfSource& source, SdfFile& result) : source_(source), result_(result) {
        result_.stand_ins.emplace(text_path, source.file);
    }

    void read(std::map<std::string, fs::path> includes) {
        for (auto& [uri, path] : includes) {
            const fs::path model = model_file_of(path);
            const std::string text = contents_of(model);
            if (is_urdf(text)) path = stand_in_for(text, model);
        }
        fs::path file = source_.file;
        const std::string text = source_.text ? *source_.text : contents_of(file);
        const bool urdf = is_urdf(text);
        if (urdf) file = stand_in_for(text, file);
        if (!result_.faults.empty()) return;

        const sdf::ParserConfig config = config_for(includes);
        const GlobalConfig global{config};
        const sdf::Errors errors = source_.text && !urdf ? result_.root.LoadSdfString(text, config)
                                                         : result_.root.Load(file.string(), config);
        add_printed();
        add_errors(errors);
    }

  private:
    /// What is wrong with the robot becomes faults.
    fs::path stand_in_for(const std::string& urdf, const fs::path& file) {
        const std::string text = sdf_from_urdf(urdf);
        const auto said = console_.take();
        for (const auto& fault : said.faults) {
            if (is_echo(fault)) continue;
            const int line = line_in_urdf(urdf, fault);
            result_.faults.push_back(file.string() + (line > 0 ? ':' + std::to_string(line) : "") +
                                     ": " + fault);
        }
        for (const auto& warning : said.warnings)
            result_.warnings.push_back(file.string() + ": " + warning);
        if (text.empty() && said.faults.empty()) {
            result_.faults.push_back(file.string() + ": is no robot that libsdformat can read");
        }
        const fs::path stand_in = folder_.write(text);
        result_.stand_ins.emplace(stand_in, file);
        return stand_in;
    }

    void add_printed() {
        const auto said = console_.take();
        for (const auto& text : said.faults) {
            if (is_echo(text)) continue;
            result_.faults.push_back(source_.file.string() + ": " + text);
        }
        for (const auto& text : said.warnings)
            result_.warnings.push_back(source_.file.string() + ": " + text);
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
        const auto path = error.FilePath().value_or(source_.file.string());
        const auto real = result_.stand_ins.find(path);
        std::string text = real == result_.stand_ins.end() ? path : real->second.string();
        if (error.LineNumber()) text += ':' + std::to_string(*error.LineNumber());
        text += ": " + error.Message();
        if (error.XmlPath()) text += " (" + *error.XmlPath() + ")";
        return text;
    }

    const SdfSource& source_;
    SdfFile& result_;
    SdfConsole console_;
    TemporaryFolder folder_;
};

}  // namespace

fs::path SdfFile::file_of(const sdf::ElementPtr& element, const fs::path& otherwise) const {
    if (!element || element->FilePath().empty()) return otherwise;
    const auto real = stand_ins.find(element->FilePath());
    return real == stand_ins.end() ? fs::path{element->FilePath()} : real->second;
}

std::string SdfFile::place_of(const sdf::ElementPtr& element, const fs::path& otherwise) const {
    const std::string file = file_of(element, otherwise).string();
    // The lines of a stand-in are not those of the file.
    const bool own =
        element && (!stand_ins.contains(element->FilePath()) || element->FilePath() == text_path);
    if (!own || !element->LineNumber()) return file;
    return file + ':' + std::to_string(*element->LineNumber());
}

SdfFile read_sdf(const SdfSource& source, const Resources& resources,
                 std::size_t most_memory_bytes) {
    SdfFile result;
    Reader reader{source, result};
    auto survey = survey_sdf(source, resources, most_memory_bytes);
    result.faults = std::move(survey.faults);
    if (result.faults.empty()) reader.read(std::move(survey.includes));
    return result;
}

}  // namespace scipd::sim
