// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "tools/options.h"
#include "tools/scipcat/run_scipfit.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scipcat_commands.h"
#include "tools/scipcat/twin_recordings.h"

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;

struct TwinOptions {
    ConnectionOptions connection;
    fs::path folder;
    double seconds = 10.0;
    bool json = false;
};

/// All that is written, but for the recordings.
struct TwinFiles {
    fs::path configuration;
    fs::path room;
    fs::path report;
};

std::vector<std::string> words_for(const std::vector<fs::path>& recordings, const TwinFiles& files,
                                   bool json) {
    std::vector<std::string> words(recordings.begin(), recordings.end());
    for (const auto& [option, file] :
         {std::pair{"--output", files.configuration}, std::pair{"--room", files.room},
          std::pair{"--report", files.report}})
        words.insert(words.end(), {option, file.string()});
    if (json) words.emplace_back("--json");
    return words;
}

std::string as_json(const std::vector<fs::path>& recordings, const TwinFiles& files,
                    const std::string& fit) {
    nlohmann::ordered_json document{{"twin", files.configuration.string()},
                                    {"room", files.room.string()},
                                    {"report", files.report.string()}};
    for (const fs::path& recording : recordings)
        document["recordings"].push_back(recording.string());
    document["fit"] = nlohmann::ordered_json::parse(fit);
    return document.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + '\n';
}

void tell_what_to_do(const std::vector<fs::path>& recordings, const TwinFiles& files) {
    std::cout << "the twin: scipd --config " << files.configuration.string()
              << "\nhow good it is: scipcat compare " << recordings.front().string()
              << " tcp://127.0.0.1:10940\nin pictures: " << files.report.string() << '\n';
}

/// A folder, with those that it lies in. In the end the ones that were not there before go, if
/// nothing was written to them.
class FolderForFiles {
  public:
    explicit FolderForFiles(const fs::path& folder) {
        for (fs::path at = fs::absolute(folder).lexically_normal(); !fs::exists(at);
             at = at.parent_path())
            made_.push_back(at);
        std::error_code error;
        fs::create_directories(folder, error);
        if (error) throw WrongInput(folder.string() + ": cannot be made: " + error.message());
    }
    FolderForFiles(const FolderForFiles&) = delete;
    FolderForFiles& operator=(const FolderForFiles&) = delete;
    ~FolderForFiles() {
        std::error_code not_empty;
        for (const fs::path& folder : made_)
            fs::remove(folder, not_empty);
    }

  private:
    std::vector<fs::path> made_;  ///< the innermost first
};

void make_twin(const TwinOptions& options) {
    require_scipfit();
    const FolderForFiles folder(options.folder);
    const auto recordings = record_for_twin(options.connection, options.seconds, options.folder);
    const TwinFiles files{options.folder / "twin.yaml", options.folder / "room.sdf",
                          options.folder / "report.html"};
    const std::string fit = run_scipfit(words_for(recordings, files, options.json));
    if (options.json) {
        std::cout << as_json(recordings, files, fit);
        return;
    }
    std::cout << fit;
    tell_what_to_do(recordings, files);
}

}  // namespace

void add_twin_command(CLI::App& program) {
    auto* const command = program.add_subcommand(
        "twin", "make a twin of a real, stationary scanner, with the room it sees");
    const auto options = std::make_shared<TwinOptions>();
    options->connection.add_to(*command);
    command
        ->add_option(
            "-o,--output", options->folder,
            "folder for twin.yaml, room.sdf, report.html and the recordings; old ones are replaced")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("--seconds", options->seconds,
                     "duration of each recording, in which nothing in view may move")
        ->check(number_within(1.0, 3600.0))
        ->capture_default_str();
    command->add_flag("--json", options->json, "print the results as a JSON document");
    command->callback([options] { make_twin(*options); });
    command->footer(
        "On a terminal it asks you to turn the scanner once. Elsewhere it asks nothing.\n"
        "Examples:\n"
        "  scipcat twin tcp://192.168.0.10:10940 -o mine/\n"
        "  scipd --config mine/twin.yaml\n"
        "  scipcat compare mine/standing.mcap tcp://127.0.0.1:10940");
}

}  // namespace scipd::tools
