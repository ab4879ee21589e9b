// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "tools/analysis/scan_table.h"
#include "tools/options.h"
#include "tools/page.h"
#include "tools/safe_output.h"
#include "tools/scipcat/plot_subject.h"
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

struct PlotOptions {
    ConnectionOptions connection;
    ScanOptions scan;
    std::uint64_t number = 1;  ///< of the scan in a recording
    std::string stream;        ///< of it; empty: the first
    std::string model;         ///< that it was recorded from; empty: the recording says where
    std::string file;          ///< empty: the terminal
    std::string title;
    std::optional<ColourBy> colour;
    TruthOptions truth;

    [[nodiscard]] bool need_truth() const {
        return colour == ColourBy::material || colour == ColourBy::error;
    }
};

/// seed: empty if it is not known.
PlotText text_of(const PlotSubject& subject, const TopView& view, const std::string& title,
                 const std::string& seed) {
    std::ostringstream scan;
    scan << view.points.size() << " points in " << view.directions << " directions";
    if (!view.further.empty()) scan << ", " << view.further.size() << " farther echoes";
    if (const std::string when = scan_text(subject); !when.empty()) scan << "  ·  " << when;
    const std::string& model = subject.identity.model;
    return {
        .title = !title.empty()  ? title
                 : model.empty() ? "a recorded scan"
                                 : model,
        .scanner = scanner_text(subject) + (seed.empty() ? "" : "  ·  seed " + seed),
        .scan = scan.str(),
    };
}

void draw_file(const std::filesystem::path& file, const TopView& view, const Colouring& colouring,
               const PlotText& text) {
    Page page(file, height_of_polar_plot(view, colouring));
    draw_polar_plot(page, view, colouring, text);
    if (const auto trouble = page.finish()) {
        throw std::runtime_error("cannot write " + file.string() + ": " + *trouble);
    }
}

/// Takes a scan now. The scipd is told of the question to come, so that it keeps the truth.
PlotSubject take_scan(PlotOptions& options) {
    ConnectedScanner scanner = options.connection.open();
    if (options.need_truth()) {
        options.truth.find_scipd();
        announce_question(options.truth, options.connection.target);
    }
    return subject_of(scanner, options.scan);
}

PlotSubject recorded_scan(const PlotOptions& options) {
    const std::string& file = options.connection.target;
    PlotSubject subject = subject_of(file, options.stream, options.number);
    if (!options.model.empty()) take_for_model(subject, options.model);
    const sim::Directions& directions = subject.scan.directions;
    if (!directions.first_rad || !directions.increment_rad)
        throw WrongInput(file +
                         " does not say where its steps look; name the model that it was "
                         "recorded from: --model");
    return subject;
}

void plot(PlotOptions options) {
    if (options.scan.intensity && !options.colour) options.colour = ColourBy::intensity;
    if (options.colour == ColourBy::intensity) options.scan.intensity = true;
    const std::string& target = options.connection.target;
    const PlotSubject subject = is_recording(target) ? recorded_scan(options) : take_scan(options);
    TopView view = make_top_view(subject.scan, subject.identity);
    std::string seed;
    if (options.need_truth()) {
        const Truth truth = ask_truth(options.truth, target, *subject.scan.stamp_ms);
        add_truth(view, truth);
        seed = truth.seed;
    }
    const Colouring colouring = colour_points(view, options.colour);
    const PlotText text = text_of(subject, view, options.title, seed);
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
    const bool recorded = is_recording(options.connection.target);
    if (recorded) options.scan.take_all_of_recording();
    if (options.need_truth() && recorded)
        throw CLI::ValidationError("--color material and error need a scanner of a scipd");
    if (options.number > 1 && !recorded) throw CLI::ValidationError("--scan needs a recording");
    if (!options.stream.empty() && !recorded)
        throw CLI::ValidationError("--stream needs a recording");
    if (!options.model.empty() && !recorded)
        throw CLI::ValidationError("--model is for recordings; a scanner reports its model");
}

}  // namespace

void add_plot_command(CLI::App& program) {
    auto* const command =
        program.add_subcommand("plot", "draw one scan from above, in the terminal or as a picture");
    const auto options = std::make_shared<PlotOptions>();
    options->connection.add_to(*command, Targets::scanners_and_recordings);
    command->add_option("--scan", options->number, "which scan of a recording to draw (1 = first)")
        ->check(whole_from(1));
    command->add_option("--stream", options->stream,
                        "scanner to use, of a recording of several; default: the first");
    command->add_option("--model", options->model,
                        "model that made a recording without angles, one of scipd --list-models");
    command->add_option("-o,--output", options->file, "the picture; default: in the terminal")
        ->check(ends_in({".png", ".svg"}));
    command->add_option("--title", options->title, "title; default: the model");
    options->scan.add_to(*command);
    command->add_flag("--echoes", options->scan.echoes,
                      "draw the second and third echoes as well, as other marks");
    command
        ->add_option("--color", options->colour,
                     "quantity shown as colour: distance, intensity, or, for a scanner of scipd, "
                     "material or error (sent - true)")
        ->transform(CLI::CheckedTransformer(colour_names())
                        .description(CLI::detail::generate_map(colour_names(), true)));
    options->truth.add_to(*command);
    command->callback([options] {
        check(*options);
        plot(*options);
    });
    command->footer(
        "Forward is up, and left is left. What is out of range is not drawn.\n"
        "Materials and errors are read from the control socket of scipd.\n"
        "Examples:\n"
        "  scipcat plot tcp://127.0.0.1:10940\n"
        "  scipcat plot tcp://127.0.0.1:10940 --color error\n"
        "  scipcat plot room.mcap --scan 40\n"
        "  scipcat plot table.txt --model UST-10LX\n"
        "  scipcat plot /dev/ttyACM0 -o maze.png --title 'Rescue maze' --intensity");
}

}  // namespace scipd::tools
