// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <memory>
#include <string>
#include <string_view>

#include "sim/recording/create_recording.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipcat/proxy/run_proxy.h"
#include "tools/scipcat/proxy_recording.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scipcat_commands.h"
#include "tools/target.h"

namespace scipd::tools {
namespace {

struct ProxyOptions {
    ConnectionOptions connection;
    ProxyWanted wanted;
    std::string file;
    double tolerance_m = 0.1;
};

void run(ProxyOptions& options) {
    ProxyWanted& wanted = options.wanted;
    if (!wanted.listen.empty() && !wanted.pty.empty())
        throw WrongInput("--listen and --pty do not go together: give one of both");
    if (wanted.listen.empty() && wanted.pty.empty())
        throw WrongInput("drivers need an address of the proxy: --listen ADDR:PORT or --pty LINK");
    wanted.scanner = options.connection.target;
    wanted.target = parse_target(wanted.scanner);
    wanted.open.baud = options.connection.baud;
    wanted.tolerance_mm = 1000.0 * options.tolerance_m;
    if (options.file.empty()) return run_proxy(wanted, {});
    ProxyRecording recording(options.file);
    run_proxy(wanted, [&](bool to_scanner, sim::HostTime time, std::string_view bytes) {
        recording.hear(to_scanner, time, bytes);
    });
    recording.finish();
}

}  // namespace

void add_proxy_command(CLI::App& program) {
    auto* const command = program.add_subcommand(
        "proxy", "forward between a driver and a scanner: record, compare, inject faults");
    const auto options = std::make_shared<ProxyOptions>();
    ProxyWanted& wanted = options->wanted;
    options->connection.add_to(*command);
    command
        ->add_option("--listen", wanted.listen,
                     "address for drivers to connect to; port 0 picks a free port")
        ->type_name("ADDR:PORT");
    command->add_option("--pty", wanted.pty, "path of a tty for drivers to open")
        ->type_name("LINK");
    const CLI::Validator writable(can_be_written, "", "file");
    command
        ->add_option("-o,--output", options->file,
                     "a recording; an old file is replaced. The ending names the format: .mcap "
                     "has all that goes to the scanner and comes from it, .ubh, .csv and .jsonl "
                     "have the scans")
        ->check(ends_in({sim::recording_endings.begin(), sim::recording_endings.end()}))
        ->check(writable);
    command
        ->add_option("--twin", wanted.twin,
                     "compare each scan with those of this scanner, or of the only one of this "
                     "configuration of scipd")
        ->type_name("TARGET|CONFIG");
    command
        ->add_option("--tolerance", options->tolerance_m,
                     "largest difference allowed, in m; default: 0.1")
        ->check(number_within(0.001, 100));
    command
        ->add_option("--fault", wanted.faults,
                     "fault to inject, such as stall,at.s=5,for.s=2; may be given more than once")
        ->type_name("KIND[,MEMBER=VALUE...]")
        ->take_all();
    command->add_flag("--json", wanted.json, "as JSON, an object a line");
    command->callback([options] { run(*options); });
    command->footer(
        "One driver is served at a time, and the next ones wait, as at a real scanner.\n"
        "Ctrl-C ends it.\n"
        "Examples:\n"
        "  scipcat proxy tcp://192.168.0.10:10940 --listen 127.0.0.1:10940 -o day.mcap\n"
        "  scipcat proxy /dev/ttyACM0 --pty /tmp/urg --twin twin.yaml\n"
        "  scipcat proxy /dev/ttyACM0 --listen 127.0.0.1:0 --fault corrupt,bytes.rate=0.001");
}

}  // namespace scipd::tools
