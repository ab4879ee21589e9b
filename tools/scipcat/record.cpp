// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "sim/recording/create_recording.h"
#include "tools/options.h"
#include "tools/scipcat/live_recording.h"
#include "tools/scipcat/running_stream.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scan_progress.h"
#include "tools/scipcat/scipcat_commands.h"

namespace scipd::tools {
namespace {

using sim::mcap::Compression;

struct RecordOptions {
    ConnectionOptions connection;
    ScanOptions scan;
    std::string file;
    std::uint64_t scans = 0;  ///< 0: until interrupted
    Compression compression = Compression::zstd;
};

/// Until there are enough scans, the user has enough, or the scanner is gone: then its Error is
/// returned.
std::exception_ptr copy_scans(ConnectedScanner& scanner, LiveRecording& recording) {
    ScanProgress progress;
    try {
        while (!recording.has_all()) {
            (void)scanner.driver().next_scan();
            recording.write();
            progress.tell(recording.scans());
        }
    } catch (const Interrupted&) {
    } catch (const protocol::client::Error&) {
        return std::current_exception();
    }
    return nullptr;
}

void report(const LiveRecording& recording, ConnectedScanner& scanner, const std::string& file) {
    const std::uint64_t count = recording.scans();
    std::cerr << count << (count == 1 ? " scan" : " scans") << " recorded to " << file;
    if (const std::size_t damaged = scanner.driver().damaged_scans(); damaged > 0) {
        std::cerr << "; " << damaged << " came damaged and were left out";
    }
    std::cerr << '\n';
}

void record(const RecordOptions& options) {
    LiveRecording recording(options.scans);
    ConnectedScanner scanner = options.connection.open(
        [&](bool to_scanner, std::string_view bytes) { recording.hear(to_scanner, bytes); });
    (void)scanner.driver().state();  // it belongs to what the recording says of the scanner
    const auto request = options.scan.request(scanner.parameters());
    recording.forget_scans();
    std::exception_ptr trouble;
    {
        const RunningStream stream(scanner.driver(), request);
        scanner.transport().interrupt_on_signals();
        recording.write_to(sim::create_recording(
            options.file, recording.identity(),
            {.name = "scipcat", .version = SCIPD_VERSION, .compression = options.compression}));
        trouble = copy_scans(scanner, recording);
    }
    recording.finish();
    if (trouble) std::rethrow_exception(trouble);
    report(recording, scanner, options.file);
}

std::map<std::string, Compression> compression_names() {
    return {{"zstd", Compression::zstd}, {"lz4", Compression::lz4}, {"none", Compression::none}};
}

}  // namespace

void add_record_command(CLI::App& program) {
    auto* const command = program.add_subcommand("record", "record scans in a file");
    const auto options = std::make_shared<RecordOptions>();
    options->connection.add_to(*command);
    command
        ->add_option("-o,--output", options->file,
                     "the recording; an old file is replaced. The ending names the format: .mcap "
                     "has every byte both ways, for Foxglove and Lichtblick; .ubh is UrgBenri's")
        ->required()
        ->check(ends_in({sim::recording_endings.begin(), sim::recording_endings.end()}));
    command->add_option("-n,--scans", options->scans, "how many scans; default: until Ctrl-C")
        ->check(whole_from(1));
    options->scan.add_to(*command);
    command->add_flag("--echoes", options->scan.echoes,
                      "ask for every echo (UTM-30LX-EW, UXM-30LX)");
    command->add_option("--compression", options->compression, "of .mcap; default: zstd")
        ->transform(CLI::CheckedTransformer(compression_names())
                        .description(CLI::detail::generate_map(compression_names(), true)));
    command->callback([options] { record(*options); });
    command->footer(
        "Examples:\n"
        "  scipcat record tcp://127.0.0.1:10940 -o room.mcap\n"
        "  scipcat record tcp://127.0.0.1:10940 -o room.csv -n 400\n"
        "  scipcat record /dev/ttyACM0 -o front.jsonl --start 360 --end 720 --intensity\n"
        "  python3 -c 'import numpy; print(numpy.loadtxt(\"room.csv\", delimiter=\",\").shape)'");
}

}  // namespace scipd::tools
