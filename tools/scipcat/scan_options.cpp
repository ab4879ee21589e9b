// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/scan_options.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "tools/analysis/scan_table.h"
#include "tools/options.h"
#include "tools/target.h"

namespace scipd::tools {
namespace {

constexpr int max_step = 9999;
constexpr int max_cluster = 99;

std::string why_no_scanner(const std::string& text) {
    try {
        (void)parse_target(text);
        return {};
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

std::string why_no_target(const std::string& text) {
    return is_recording(text) ? "" : why_no_scanner(text);
}

constexpr auto scanner = "the scanner: tcp://HOST:PORT, or a tty such as /dev/ttyACM0";

}  // namespace

void add_target(CLI::App& command, const std::string& name, std::string& target, Targets targets) {
    const bool recordings = targets == Targets::scanners_and_recordings;
    command
        .add_option(
            name, target,
            scanner + std::string(recordings ? "; or a recording: FILE, FOLDER or FILE+FILE" : ""))
        ->required()
        ->check(CLI::Validator(recordings ? why_no_target : why_no_scanner, "", "target"));
}

void ConnectionOptions::add_to(CLI::App& command, Targets targets, const std::string& name) {
    add_target(command, name, target, targets);
    command.add_option("--baud", baud, "bit rate of a tty; has no effect on a USB scanner")
        ->check(whole_within(1200, 4'000'000))
        ->capture_default_str();
    command.add_option("--timeout", timeout_s, "seconds to wait for each answer")
        ->check(number_within(0.01, 3600.0))
        ->capture_default_str();
}

std::chrono::milliseconds ConnectionOptions::patience() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(timeout_s));
}

// A scan may take a tenth of a second longer than an answer.
ConnectedScanner ConnectionOptions::open(TappedTransport::Listener listener) const {
    const auto answer = patience();
    const OpenOptions open_options{.connect_timeout = 3 * answer, .baud = baud};
    return {parse_target(target),
            open_options,
            {.reply = answer, .scan = 2 * answer},
            std::move(listener)};
}

void ScanOptions::add_to(CLI::App& command) {
    const CLI::Validator steps = whole_within(0, max_step);
    command
        .add_option("--start", start, "first step; default: the first that the scanner measures")
        ->check(steps);
    command.add_option("--end", end, "last step; default: the last that the scanner measures")
        ->check(steps);
    command.add_option("--cluster", cluster, "how many neighbouring steps give one value")
        ->check(whole_within(1, max_cluster))
        ->capture_default_str();
    command.add_flag("--intensity", intensity, "request intensities as well");
}

protocol::client::ScanRequest ScanOptions::request(
    const protocol::client::Parameters& parameters) const {
    return {
        .first_step = start.value_or(parameters.amin),
        .last_step = end.value_or(parameters.amax),
        .cluster = cluster,
        .intensity = intensity,
        .echoes = echoes,
    };
}

void ScanOptions::take_all_of_recording() const {
    if (start || end || cluster != 1)
        throw WrongInput(
            "--start, --end and --cluster are requests to a scanner: leave them out for a "
            "recording");
}

CLI::Validator ends_in(const std::vector<std::string>& endings) {
    std::string files;
    std::string names;
    for (const std::string& ending : endings) {
        files += (files.empty() ? "FILE" : "|FILE") + ending;
        names += (names.empty() ? "" : &ending == &endings.back() ? " and " : ", ") + ending;
    }
    const auto why_not = [=](const std::string& file) -> std::string {
        const std::string ending = std::filesystem::path(file).extension();
        if (std::ranges::find(endings, ending) != endings.end()) return {};
        return "\"" + file + "\" ends in none of " + names;
    };
    return {why_not, files, "ending"};
}

}  // namespace scipd::tools
