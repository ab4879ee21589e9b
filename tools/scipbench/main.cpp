// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipbench: compares how fast the ways to compute ranges are on this machine, and how far they
// differ; and loads scanners.
#include <chrono>
#include <cstddef>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "daemon/config/demo_world.h"
#include "daemon/models/model_registry.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"
#include "sim/loaders/scene_file.h"
#include "sim/sensor/scanner.h"
#include "tools/options.h"
#include "tools/output_file.h"
#include "tools/scipbench/capacity_command.h"
#include "tools/scipbench/chart.h"
#include "tools/scipbench/compare.h"
#include "tools/scipbench/compare_stages.h"
#include "tools/scipbench/load.h"
#include "tools/scipbench/machine.h"
#include "tools/scipbench/table3.h"

namespace scipd::tools {
namespace {

struct Said {
    std::string scene;
    std::string csv;
    std::string plot;
    int repetitions = 300;
    std::string model = "UST-10LX";
    std::size_t poses = 50;
    double height_m = robot_height_m;
    bool json = false;
    bool light = false;
    std::vector<std::string> targets;
    int seconds = 10;
};

/// Prints the warnings of the world on standard error, so that the table stays clean.
sim::SharedScene load(const Said& said) {
    try {
        auto loaded =
            sim::load_scene(said.scene, {.sdf = {.model_folders = daemon::stock_models()}});
        for (const std::string& warning : loaded.warnings)
            std::cerr << "scipbench: " << warning << "\n";
        return loaded.scene;
    } catch (const sim::LoadError& error) {
        throw WrongInput(error.what());
    }
}

/// The consequence for a table, and the reason; empty if this machine can draw.
std::string what_is_missing(const std::string& consequence) {
    const std::string why = why_nothing_is_drawn();
    return why.empty() ? why : consequence + ": " + why + "; `scipd --probe` shows more";
}

/// Prints it before the measuring begins, which takes minutes. Returns whether anything is missing.
bool tell_what_is_missing(const std::string& consequence) {
    const std::string missing = what_is_missing(consequence);
    if (!missing.empty()) std::cerr << "scipbench: " << missing << "\n";
    return !missing.empty();
}

void run_table3(const Said& said) {
    const sim::SharedScene scene = load(said);
    const std::string machine = describe_machine();
    const bool draws = !tell_what_is_missing("only rays are measured");
    const auto rows = measure_table3(scene, said.repetitions, said.height_m, draws);
    std::cout << machine << "\n" << said.scene << "\n\n";
    print_table3(rows, std::cout);
    write_to(said.csv, [&](std::ostream& out) { write_table3_csv(rows, out); });
    if (!said.plot.empty()) draw_table3(rows, machine, said.plot);
}

void run_table4(const Said& said) {
    const sim::SharedScene scene = load(said);
    const std::string missing = what_is_missing("there is nothing to read back");
    if (!missing.empty()) throw std::runtime_error(missing);
    const auto rows = measure_table4(scene, said.repetitions, said.height_m);
    std::cout << describe_machine() << "\n" << said.scene << "\n\n";
    print_table4(rows, std::cout);
    write_to(said.csv, [&](std::ostream& out) { write_table4_csv(rows, out); });
}

sim::MaterialLibrary stock_library() {
    const auto file = daemon::stock_materials();
    if (!file) throw std::runtime_error(file.error().why);
    sim::MaterialLibrary library;
    for (sim::MaterialOptics& material : sim::load_materials(*file))
        library.add(std::move(material));
    return library;
}

void run_compare(const Said& said) {
    const sim::SharedScene scene = load(said);
    const sim::SensorSpec& optics = daemon::find_model(said.model).optics;
    const sim::Scanner scanner(optics, {.accuracy = sim::Accuracy::ideal});
    const std::vector<glm::vec3> directions(scanner.directions().begin(),
                                            scanner.directions().end());
    tell_what_is_missing("depth is not compared");
    const auto scans =
        compare_backends(scene, directions, optics.max_range_m, said.poses, said.height_m);
    if (said.json) {
        write_comparison_json(scans, std::cout);
    } else {
        std::cout << describe_machine() << "\n"
                  << said.scene << ", " << said.model << ", " << said.poses << " poses\n\n";
        print_comparison(scans, std::cout);
        if (said.light) {
            print_stages(compare_stages(scene, optics, stock_library(), said.poses, said.height_m),
                         std::cout);
        }
    }
    if (!said.plot.empty()) draw_differences(scans, said.model + " in " + said.scene, said.plot);
}

void run_load(const Said& said) {
    const LoadReport report = load_scanners(said.targets, std::chrono::seconds(said.seconds));
    said.json ? write_load_json(report, std::cout) : print_load(report, std::cout);
    if (const std::size_t unsound = report.unsound(); unsound > 0) {
        throw std::runtime_error(std::to_string(unsound) + " of " +
                                 std::to_string(report.streams.size()) +
                                 " streams are not whole; they are named above");
    }
}

std::string is_target(const std::string& text) {
    try {
        (void)parse_target(text);
        return "";
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

void add_load(CLI::App& program, Said& said) {
    CLI::App* load = program.add_subcommand(
        "load", "stream from all scanners at once, and check every byte received");
    load->add_option("TARGET", said.targets,
                     "scanners, real or emulated: tcp://HOST:PORT or a tty, each")
        ->required()
        ->check(is_target);
    load->add_option("-s,--seconds", said.seconds, "how long")
        ->check(whole_within(1, 1'000'000))
        ->capture_default_str();
    load->add_flag("--json", said.json, "as a JSON document");
    load->callback([&said] { run_load(said); });
}

std::string is_model(const std::string& name) {
    const auto model = daemon::model_named(name);
    return model ? "" : model.error().why;
}

CLI::App* add(CLI::App& program, const char* name, const char* what, Said& said,
              void (*run)(const Said&)) {
    CLI::App* command = program.add_subcommand(name, what);
    command->add_option("--scene", said.scene, "world to measure in")
        ->required()
        ->check(CLI::ExistingFile)
        ->option_text("FILE");
    command->add_option("--height", said.height_m, "height of the scanner in the world, in metres")
        ->check(number_within(-1e6, 1e6))
        ->option_text("METRES [0.3]");
    command->callback([&said, run] { run(said); });
    return command;
}

void add_plot(CLI::App& command, Said& said) {
    command.add_option("-o,--plot", said.plot, "picture to draw")
        ->check(is_picture)
        ->check(can_be_written)
        ->option_text("FILE.png|FILE.svg");
}

void add_table_options(CLI::App& command, Said& said) {
    command.add_option("--csv", said.csv, "table to write")
        ->check(can_be_written)
        ->option_text("FILE.csv");
    command
        .add_option("-n,--repetitions", said.repetitions,
                    "number of repetitions of each measurement")
        ->check(whole_within(2, 100'000))
        ->capture_default_str();
}

}  // namespace
}  // namespace scipd::tools

int main(int argc, char** argv) {
    using namespace scipd::tools;
    CLI::App program("Compares range backends and measures the capacity of this machine.",
                     "scipbench");
    program.require_subcommand(1);
    Said said;
    CLI::App* table3 = add(program, "table3",
                           "measure the cost of a scan at each resolution, by rays and by depth "
                           "buffer, as in the paper's Table 3",
                           said, run_table3);
    add_table_options(*table3, said);
    add_plot(*table3, said);
    CLI::App* table4 =
        add(program, "table4", "measure the cost of reading back, as in the paper's Table 4", said,
            run_table4);
    add_table_options(*table4, said);
    CLI::App* compare =
        add(program, "compare", "cast the same scans with every backend, and compare them", said,
            run_compare);
    compare->add_option("--model", said.model, "a scanner of `scipd --list-models`")
        ->check(is_model)
        ->option_text("MODEL");
    compare->add_option("--poses", said.poses, "number of scans, each from another pose")
        ->check(whole_within(2, 100'000))
        ->capture_default_str();
    compare->add_flag("--json", said.json, "as a JSON document");
    compare
        ->add_flag("--light", said.light,
                   "also compare echoes and readings at accuracy material, with the materials of "
                   "scipd")
        ->excludes("--json");
    add_plot(*compare, said);
    add_load(program, said);
    add_capacity(program);
    add_lockstep(program);
    // Last, since commands take it over.
    program.footer("scipbench COMMAND --help shows the options of a command.");
    add_completion_command(program);
    return run(program, argc, argv);
}
