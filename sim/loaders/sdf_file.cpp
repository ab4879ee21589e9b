// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf_file.h"

#include <mutex>
#include <sstream>

#include <sdf/Console.hh>
#include <sdf/Element.hh>
#include <sdf/Filesystem.hh>
#include <sdf/ParserConfig.hh>
#include <sdf/SDFImpl.hh>

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

/// libsdformat 12 returns some faults and prints others, and warnings are only printed: this takes
/// down what it prints.
class ConsoleListener {
  public:
    ConsoleListener() : turn_(one_at_a_time()) {
        sdf::Console::Instance()->GetMsgStream().SetStream(&text_);
    }
    ~ConsoleListener() { sdf::Console::Instance()->GetMsgStream().SetStream(nullptr); }
    ConsoleListener(const ConsoleListener&) = delete;
    ConsoleListener& operator=(const ConsoleListener&) = delete;

    /// A message begins `ESC[1;33mWarning [Utils.cc:129]ESC[0m `, or with Error, and may have
    /// several lines.
    void sort_into(std::vector<std::string>& faults, std::vector<std::string>& warnings) {
        std::vector<std::string>* last = nullptr;
        for (std::string line; std::getline(text_, line);) {
            const auto end = line.find("\x1b[0m ");
            if (!line.starts_with('\x1b') || end == line.npos) {
                if (last != nullptr && !line.empty()) last->back() += ' ' + line;
                continue;
            }
            last = line.find("mError ") < end ? &faults : &warnings;
            last->push_back(line.substr(end + 5));
        }
    }

  private:
    static std::mutex& one_at_a_time() {
        static std::mutex mutex;
        return mutex;
    }

    std::lock_guard<std::mutex> turn_;
    std::stringstream text_;
};

sdf::ParserConfig config_for(const fs::path& file) {
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetFindCallback([](const std::string&) { return std::string{}; });
    const auto folder = file.parent_path();
    // The empty scheme: what an include names is looked for beside the file first, and not where
    // the program runs.
    for (const char* scheme : {"", "model://", "file://", "package://"}) {
        config.AddURIPath(scheme, folder.string());
        config.AddURIPath(scheme, folder.parent_path().string());
    }
    return config;
}

std::string describe(const sdf::Error& error, const fs::path& file) {
    std::string text = error.FilePath().value_or(file.string());
    if (error.LineNumber()) text += ':' + std::to_string(*error.LineNumber());
    text += ": " + error.Message();
    if (error.XmlPath()) text += " (" + *error.XmlPath() + ")";
    return text;
}

/// One unreadable element makes the library complain once more about every element around it, and
/// one lost frame about the whole graph of frames.
bool is_echo(const sdf::Error& error, const std::string& last_path) {
    const auto message = error.Message();
    if (message.starts_with("Error reading element")) {
        return !last_path.empty() && last_path.starts_with(error.XmlPath().value_or(""));
    }
    return message.starts_with("Unable to read file") ||
           message.starts_with("Failed to load a world") ||
           error.Code() == sdf::ErrorCode::POSE_RELATIVE_TO_GRAPH_ERROR;
}

void add_errors(const sdf::Errors& errors, const fs::path& file, std::vector<std::string>& faults) {
    std::string last_path;
    for (const auto& error : errors) {
        if (is_echo(error, last_path)) continue;
        last_path = error.XmlPath().value_or("");
        faults.push_back(describe(error, file));
    }
    if (!faults.empty()) return;
    for (const auto& error : errors)
        faults.push_back(describe(error, file));
}

}  // namespace

SdfFile read_sdf_file(const fs::path& file) {
    SdfFile result;
    ConsoleListener listener;
    const sdf::Errors errors = result.root.Load(file.string(), config_for(file));
    std::vector<std::string> printed;
    listener.sort_into(printed, result.warnings);
    for (const auto& text : printed)
        result.faults.push_back(file.string() + ": " + text);
    add_errors(errors, file, result.faults);
    for (auto& warning : result.warnings)
        warning.insert(0, file.string() + ": ");
    return result;
}

std::string place_of(const sdf::ElementPtr& element, const fs::path& file) {
    if (!element || element->FilePath().empty()) return file.string();
    const auto line = element->LineNumber();
    return element->FilePath() + (line ? ':' + std::to_string(*line) : std::string{});
}

fs::path find_resource(const std::string& uri, const fs::path& folder) {
    const auto scheme_end = uri.find("://");
    const fs::path name = scheme_end == uri.npos ? uri : uri.substr(scheme_end + 3);
    const fs::path inside =
        name.lexically_relative(*name.begin());  // MODEL/meshes/x from within MODEL
    for (const auto& candidate : {folder / name, folder.parent_path() / name, folder / inside}) {
        if (fs::is_regular_file(candidate)) return candidate;
    }
    // SDF_PATH, and wherever else the library has been told to look.
    return sdf::findFile(uri, false, false);
}

}  // namespace scipd::sim
