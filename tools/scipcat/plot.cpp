// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tools/page.h"
#include "tools/scipcat/commands.h"
#include "tools/scipcat/plot_text.h"
#include "tools/scipcat/polar_plot.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/terminal_plot.h"
#include "tools/scipcat/top_view.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

using protocol::client::ScanMessage;

struct PlotOptions {
    ConnectionOptions connection;
    ScanOptions scan;
    std::string file;  ///< empty: the terminal
    std::string title;
};

/// Uses a stream of one scan, which switches the laser on and off by itself.
ScanMessage one_scan(Scanner& scanner, const ScanOptions& options) {
    auto request = options.request(scanner.parameters());
    request.scans = 1;
    scanner.driver().start(request);
    const ScanMessage scan = scanner.driver().next_scan();
    scanner.driver().stop();
    return scan;
}

PlotText text_of(const Scanner& scanner, const ScanMessage& scan, const TopView& view,
                 const std::string& title) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    std::ostringstream of_scan;
    of_scan << view.points.size() << " points in " << view.directions << " directions  ·  stamp "
            << scan.stamp_ms << " ms  ·  " << std::put_time(&local, "%F %T");
    return {
        .title = title.empty() ? scanner.model() : title,
        .scanner = scanner.model() + "  ·  serial " + scanner.version().serial + "  ·  firmware " +
                   scanner.version().firmware,
        .scan = of_scan.str(),
    };
}

void draw_file(const std::filesystem::path& file, const TopView& view, const PlotText& text) {
    Page page(file);
    draw_polar_plot(page.context(), view, text);
    if (const auto trouble = page.finish()) {
        throw std::runtime_error("cannot write " + file.string() + ": " + *trouble);
    }
}

void plot(const PlotOptions& options) {
    Scanner scanner = options.connection.open();
    const ScanMessage scan = one_scan(scanner, options.scan);
    const TopView view = make_top_view(scan, scanner.parameters());
    const PlotText text = text_of(scanner, scan, view, options.title);
    if (options.file.empty()) {
        std::cout << terminal_plot(view, text, terminal_size());
    } else {
        draw_file(options.file, view, text);
    }
}

}  // namespace

void add_plot_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("plot", "draw one scan from above, in the terminal or as a picture");
    const auto options = std::make_shared<PlotOptions>();
    options->connection.add_to(*command);
    command->add_option("-o,--output", options->file, "the picture (default: in the terminal)")
        ->check(ends_in(".png", ".svg"));
    command->add_option("--title", options->title, "title (default: the model)");
    options->scan.add_to(*command);
    command->callback([options] { plot(*options); });
    command->footer(
        "Forward is up, and left is left. What is out of range is not drawn.\n"
        "Examples:\n"
        "  scipcat plot tcp://127.0.0.1:10940\n"
        "  scipcat plot /dev/ttyACM0 -o maze.png --title 'Rescue maze' --intensity");
}

}  // namespace scipd::tools
