// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/client/error.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/safe_output.h"
#include "tools/scipcat/check/check_report.h"
#include "tools/scipcat/check/run_checks.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scipcat_commands.h"
#include "tools/target.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

struct CheckOptions {
    ConnectionOptions connection;
    checks::Wanted wanted;
    std::string junit;
    std::string html;
    bool json = false;
};

std::string why_no_section(const std::string& section) {
    if (checks::is_section(section)) return "";
    return "there is no section " + section + "; chapters are 1 to " +
           std::to_string(checks::chapters().size()) + ", and checks are named like 4.2";
}

/// A line that is written over itself, for somebody who watches.
void show_progress(std::size_t done, std::size_t of, const checks::Check& next) {
    SafeOutput::write_as_is(std::cerr, "\r\x1b[K" + std::to_string(done) + " of " +
                                           std::to_string(of) + "  " + std::string(next.id) + " " +
                                           std::string(next.title).substr(0, 60));
}

void clear_progress() {
    SafeOutput::write_as_is(std::cerr, "\r\x1b[K");
}

checks::Conversation::Place place_of(const ConnectionOptions& connection) {
    constexpr std::chrono::seconds longest{44};
    const OpenOptions open{.baud = connection.baud};
    return {parse_target(connection.target), open, connection.patience(),
            checks::Clock::now() + longest};
}

checks::CheckReport make_report(const CheckOptions& options) {
    const bool watched = stderr_is_terminal();
    const checks::Progress silent = [](std::size_t, std::size_t, const checks::Check&) {};
    try {
        checks::CheckReport report =
            checks::run_checks(place_of(options.connection), options.wanted,
                               watched ? checks::Progress(show_progress) : silent);
        if (watched) clear_progress();
        report.target = options.connection.target;
        return report;
    } catch (const protocol::client::Error& error) {
        throw WrongInput(error.what());
    }
}

void check_scanner(const CheckOptions& options) {
    const checks::CheckReport report = make_report(options);
    write_to(options.junit, [&](std::ostream& out) { out << as_junit(report); });
    write_to(options.html, [&](std::ostream& out) { out << as_html(report); });
    std::cout << (options.json ? as_json(report) : as_text(report)) << std::flush;
    if (!report.gone.empty())
        throw WrongInput(report.gone + "; the remaining checks were not made");
    if (report.interrupted) throw std::runtime_error("interrupted before all checks were made");
    if (const std::size_t failed = report.count(checks::Verdict::fail); failed > 0)
        throw std::runtime_error(std::to_string(failed) + " of " +
                                 std::to_string(report.results.size()) + " checks failed");
}

}  // namespace

void add_check_command(CLI::App& program) {
    auto* const command = program.add_subcommand(
        "check", "check that the scanner conforms to SCIP and to recorded firmware behaviour");
    const auto options = std::make_shared<CheckOptions>();
    options->connection.add_to(*command);
    command
        ->add_option("--section", options->wanted.sections,
                     "only this chapter (4) or check (4.2); may be given more than once")
        ->check(CLI::Validator(why_no_section, "", "section"))
        ->take_all();
    command->add_flag("--unsafe", options->wanted.unsafe,
                      "also run checks that write settings, stop the motor or reboot");
    const CLI::Validator writable(can_be_written, "", "file");
    command->add_option("--junit", options->junit, "write a JUnit report (XML), for build servers")
        ->check(writable);
    command->add_option("--html", options->html, "write a report as an HTML page")->check(writable);
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([options] { check_scanner(*options); });
    command->footer(
        "The exit code is 0 if no check fails, 1 if some do, 2 if no scanner answers or it "
        "goes away.\n"
        "Examples:\n"
        "  scipcat check tcp://192.168.0.10:10940\n"
        "  scipcat check /dev/ttyACM0 --section 6 --section 4.2 --json\n"
        "  scipcat check tcp://127.0.0.1:10940 --junit check.xml --html check.html");
}

}  // namespace scipd::tools
