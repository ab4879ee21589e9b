// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "sim/recording/create_recording.h"
#include "tools/options.h"
#include "tools/scipcat/record_scans.h"
#include "tools/scipcat/scan_options.h"
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

void report(const Recorded& recorded, const std::string& file) {
    std::cerr << recorded.scans << (recorded.scans == 1 ? " scan" : " scans") << " recorded to "
              << file;
    if (recorded.damaged > 0)
        std::cerr << "; " << recorded.damaged << " arrived damaged and were dropped";
    std::cerr << '\n';
}

void record(const RecordOptions& options) {
    const Recorded recorded =
        record_scans(options.connection, options.scan, {.scans = options.scans, .seconds = {}},
                     options.file, options.compression);
    report(recorded, options.file);
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
    command->add_option("-n,--scans", options->scans, "number of scans; default: until Ctrl-C")
        ->check(whole_from(1));
    options->scan.add_to(*command);
    command->add_flag("--echoes", options->scan.echoes,
                      "request every echo (UTM-30LX-EW, UXM-30LX)");
    command
        ->add_option("--compression", options->compression, "compression of .mcap; default: zstd")
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
