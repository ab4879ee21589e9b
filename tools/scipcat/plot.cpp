// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <chrono>
#include <ctime>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tools/page.h"
#include "tools/safe_output.h"
#include "tools/scipcat/plot_text.h"
#include "tools/scipcat/point_colours.h"
#include "tools/scipcat/polar_plot.h"
#include "tools/scipcat/scan_options.h"
#include "tools/scipcat/scipcat_commands.h"
#include "tools/scipcat/terminal_plot.h"
#include "tools/scipcat/top_view.h"
#include "tools/scipcat/truth.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

using protocol::client::ScanMessage;

struct PlotOptions {
    ConnectionOptions connection;
    ScanOptions scan;
    std::string file;  ///< empty: the terminal
    std::string title;
    std::optional<ColourBy> colour;
    TruthOptions truth;

    [[nodiscard]] bool need_truth() const {
        return colour == ColourBy::material || colour == ColourBy::error;
    }
};

/// Uses a stream of one scan, which switches the laser on and off by itself.
ScanMessage one_scan(ConnectedScanner& scanner, const ScanOptions& options) {
    auto request = options.request(scanner.parameters());
    request.scans = 1;
    scanner.driver().start(request);
    const ScanMessage scan = scanner.driver().next_scan();
    scanner.driver().stop();
    return scan;
}

PlotText text_of(const ConnectedScanner& scanner, const ScanMessage& scan, const TopView& view,
                 const std::string& title) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    std::ostringstream of_scan;
    of_scan << view.points.size() << " points in " << view.directions << " directions";
    if (!view.further.empty()) of_scan << ", " << view.further.size() << " farther echoes";
    of_scan << "  ·  stamp " << scan.stamp_ms << " ms  ·  " << std::put_time(&local, "%F %T");
    return {
        .title = title.empty() ? scanner.model() : title,
        .scanner = scanner.model() + "  ·  serial " + scanner.version().serial + "  ·  firmware " +
                   scanner.version().firmware,
        .scan = of_scan.str(),
    };
}

void draw_file(const std::filesystem::path& file, const TopView& view, const Colouring& colouring,
               const PlotText& text) {
    Page page(file, height_of_polar_plot(view, colouring));
    draw_polar_plot(page.context(), view, colouring, text);
    if (const auto trouble = page.finish()) {
        throw std::runtime_error("cannot write " + file.string() + ": " + *trouble);
    }
}

/// Takes the scan, and asks the scipd for its truth before that is forgotten.
void plot(PlotOptions options) {
    if (options.scan.intensity && !options.colour) options.colour = ColourBy::intensity;
    if (options.colour == ColourBy::intensity) options.scan.intensity = true;
    ConnectedScanner scanner = options.connection.open();
    if (options.need_truth()) {
        options.truth.find_scipd();
        announce_question(options.truth, options.connection.target);
    }
    const ScanMessage scan = one_scan(scanner, options.scan);
    TopView view = make_top_view(scan, scanner.parameters());
    if (options.need_truth())
        add_truth(view, ask_truth(options.truth, options.connection.target, scan.stamp_ms));
    const Colouring colouring = colour_points(view, options.colour);
    const PlotText text = text_of(scanner, scan, view, options.title);
    if (options.file.empty()) {
        SafeOutput::write_as_is(std::cout, terminal_plot(view, colouring, text, terminal_size()));
    } else {
        draw_file(options.file, view, colouring, text);
    }
}

std::map<std::string, ColourBy> colour_names() {
    return {{"distance", ColourBy::distance},
            {"intensity", ColourBy::intensity},
            {"material", ColourBy::material},
            {"error", ColourBy::error}};
}

void check(const PlotOptions& options) {
    if (options.need_truth() && options.scan.cluster > 1)
        throw CLI::ValidationError("--color material and error need --cluster 1");
}

}  // namespace

void add_plot_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("plot", "draw one scan from above, in the terminal or as a picture");
    const auto options = std::make_shared<PlotOptions>();
    options->connection.add_to(*command);
    command->add_option("-o,--output", options->file, "the picture; default: in the terminal")
        ->check(ends_in(".png", ".svg"));
    command->add_option("--title", options->title, "title; default: the model");
    options->scan.add_to(*command);
    command->add_flag("--echoes", options->scan.echoes,
                      "draw the second and third echoes as well, as other marks");
    command
        ->add_option("--color", options->colour,
                     "what colours mean: distance, intensity, or, of a scipd's scanner, material "
                     "or error (sent - true)")
        ->transform(CLI::CheckedTransformer(colour_names())
                        .description(CLI::detail::generate_map(colour_names(), true)));
    options->truth.add_to(*command);
    command->callback([options] {
        check(*options);
        plot(*options);
    });
    command->footer(
        "Forward is up, and left is left. What is out of range is not drawn.\n"
        "A scipd's control socket tells the materials and errors of its scanners.\n"
        "Examples:\n"
        "  scipcat plot tcp://127.0.0.1:10940\n"
        "  scipcat plot tcp://127.0.0.1:10940 --color error\n"
        "  scipcat plot /dev/ttyACM0 -o maze.png --title 'Rescue maze' --intensity");
}

}  // namespace scipd::tools
