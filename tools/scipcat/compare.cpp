// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "tools/analysis/scan_table.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipcat/compare/comparison_report.h"
#include "tools/scipcat/compare_picture.h"
#include "tools/scipcat/compare_take.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scipcat_commands.h"

namespace scipd::tools {
namespace {

struct CompareOptions {
    TakeOptions a;
    TakeOptions b;
    ScanOptions scan;
    std::string file;
    bool no_fit = false;
    bool json = false;
};

comparing::Comparison comparison_of(const CompareOptions& options) {
    if (is_recording(options.a.connection.target) && is_recording(options.b.connection.target))
        options.scan.take_all_of_recording();
    try {
        const auto a = take_scans(options.a, options.scan, "A");
        const auto b = take_scans(options.b, options.scan, "B");
        auto comparison = comparing::compare(a, b, !options.no_fit);
        if (!comparison) throw WrongInput(comparison.error().why);
        return *std::move(comparison);
    } catch (const Interrupted&) {
        throw WrongInput("interrupted before there were enough scans");
    }
}

void write_report(const std::string& file, const comparing::Comparison& comparison) {
    const auto ending = std::filesystem::path(file).extension();
    if (ending == ".png") return draw_comparison(file, comparison);
    write_to(file, [&](std::ostream& out) {
        out << (ending == ".html" ? as_html(comparison) : as_json(comparison));
    });
}

void compare(const CompareOptions& options) {
    const comparing::Comparison comparison = comparison_of(options);
    if (!options.file.empty()) write_report(options.file, comparison);
    std::cout << (options.json ? as_json(comparison) : as_text(comparison)) << std::flush;
    if (!comparison.alike()) throw std::runtime_error("B differs from A");
}

}  // namespace

void add_compare_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("compare", "compare the scans of two scanners or recordings");
    const auto options = std::make_shared<CompareOptions>();
    options->a.connection.add_to(*command, Targets::scanners_and_recordings, "A");
    add_target(*command, "B", options->b.connection.target, Targets::scanners_and_recordings);
    command
        ->add_option("-n,--scans", options->a.scans,
                     "number of scans of each; default: 100 of a scanner, all of a recording")
        ->check(whole_from(4));
    options->scan.add_to(*command);
    command->add_option("--stream-a", options->a.stream,
                        "stream of a recording to use as A; default: the first");
    command->add_option("--stream-b", options->b.stream, "the same for B");
    command->add_flag("--no-fit", options->no_fit, "take B's pose to be A's instead of fitting it");
    command
        ->add_option("-o,--output", options->file,
                     "a report: an HTML page, a picture, or all figures as JSON")
        ->check(ends_in({".html", ".png", ".json"}))
        ->check(CLI::Validator(can_be_written, "", "file"));
    command->add_flag("--json", options->json, "as a JSON document");
    command->callback([options] {
        options->b.connection.baud = options->a.connection.baud;
        options->b.connection.timeout_s = options->a.connection.timeout_s;
        options->b.scans = options->a.scans;
        compare(*options);
    });
    command->footer(
        "The exit code is 0 if they are alike, 1 if they differ, 2 if they cannot be compared.\n"
        "A difference counts if it exceeds chance and the difference between A's two halves.\n"
        "Examples:\n"
        "  scipcat compare tcp://192.168.0.10:10940 tcp://127.0.0.1:10940\n"
        "  scipcat compare real.mcap /dev/ttyACM0 -n 400\n"
        "  scipcat compare before.mcap after.mcap --no-fit -o report.html\n"
        "  scipcat compare day_0.bag+day_1.bag rosbag2_night");
}

}  // namespace scipd::tools
