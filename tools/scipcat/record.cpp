// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include "tools/options.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scan_writer.h"
#include "tools/scipcat/scipcat_commands.h"

namespace scipd::tools {
namespace {

struct RecordOptions {
    ConnectionOptions connection;
    ScanOptions scan;
    std::string file;
    std::uint64_t scans = 0;  ///< 0: until interrupted
};

/// Switches the scanner off even after an error: over a tty it would otherwise go on streaming.
class RunningStream {
  public:
    RunningStream(protocol::client::Driver& driver, const protocol::client::ScanRequest& request)
        : driver_(driver) {
        driver_.start(request);
    }
    ~RunningStream() {
        try {
            driver_.stop();
        } catch (const std::exception&) {  // it is gone; another exception tells why
        }
    }
    RunningStream(const RunningStream&) = delete;
    RunningStream& operator=(const RunningStream&) = delete;

  private:
    protocol::client::Driver& driver_;
};

/// Returns how many scans it has copied.
std::uint64_t copy_scans(ConnectedScanner& scanner, ScanWriter& writer, std::uint64_t wanted) {
    std::uint64_t count = 0;
    try {
        while (wanted == 0 || count < wanted) {
            const auto scan = scanner.driver().next_scan();
            writer.write(scan, std::chrono::system_clock::now());
            ++count;
        }
    } catch (const Interrupted&) {  // the user ends the recording; the file is whole
    }
    return count;
}

void record(const RecordOptions& options) {
    ConnectedScanner scanner = options.connection.open();
    const auto request = options.scan.request(scanner.parameters());
    std::uint64_t count = 0;
    {
        const RunningStream stream(scanner.driver(), request);
        scanner.transport().interrupt_on_signals();
        const auto& version = scanner.version();
        ScanWriter writer(options.file, {scanner.model(), version.serial, version.firmware,
                                         scanner.parameters(), request});
        count = copy_scans(scanner, writer, options.scans);
    }
    std::cerr << count << (count == 1 ? " scan" : " scans") << " recorded to " << options.file;
    if (const std::size_t damaged = scanner.driver().damaged_scans(); damaged > 0) {
        std::cerr << "; " << damaged << " came damaged and were left out";
    }
    std::cerr << '\n';
}

}  // namespace

void add_record_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("record", "record scans in a CSV or JSON lines file");
    const auto options = std::make_shared<RecordOptions>();
    options->connection.add_to(*command);
    command->add_option("-o,--output", options->file, "the recording; an old file is replaced")
        ->required()
        ->check(ends_in(".csv", ".jsonl"));
    command->add_option("-n,--scans", options->scans, "how many scans; default: until Ctrl-C")
        ->check(whole_from(1));
    options->scan.add_to(*command);
    command->add_flag("--echoes", options->scan.echoes,
                      "ask for every echo (UTM-30LX-EW, UXM-30LX)");
    command->callback([options] { record(*options); });
    command->footer(
        "Examples:\n"
        "  scipcat record tcp://127.0.0.1:10940 -o room.csv -n 400\n"
        "  scipcat record /dev/ttyACM0 -o front.jsonl --start 360 --end 720 --intensity\n"
        "  python3 -c 'import numpy; print(numpy.loadtxt(\"room.csv\", delimiter=\",\").shape)'");
}

}  // namespace scipd::tools
