// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipcat/run_scipfit.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

#include "tools/child_program.h"
#include "tools/options.h"
#include "tools/safe_output.h"
#include "tools/temporary_folder.h"
#include "tools/terminal.h"

namespace scipd::tools {
namespace {

using namespace std::chrono_literals;

/// A signal that would end us is an error, so that nothing of the fit stays behind. It is caught
/// from before the fit begins.
class Interruption {
  public:
    Interruption() {
        signals_.async_wait([this](const auto& error, int) { came_ = !error; });
    }

    [[nodiscard]] bool comes_within(std::chrono::milliseconds time) {
        context_.run_for(time);
        return came_;
    }

  private:
    boost::asio::io_context context_;
    boost::asio::signal_set signals_{context_, SIGINT, SIGTERM};
    bool came_ = false;
};

int wait_for(ChildProgram& scipfit, Interruption& interruption) {
    bool interrupted = false;
    std::optional<int> exit_code;
    const bool watched = stderr_is_terminal();
    if (watched) std::cerr << "fitting" << std::flush;
    while (!interrupted && !(exit_code = scipfit.exit_code()))
        interrupted = interruption.comes_within(10ms);
    if (watched) SafeOutput::write_as_is(std::cerr, "\r\x1b[K");
    if (interrupted) throw std::runtime_error("interrupted during the fit");
    return *exit_code;
}

/// What it says on standard error, without its name.
std::string sentence_of(std::string errors) {
    constexpr std::string_view name = "scipfit: ";
    if (errors.starts_with(name)) errors.erase(0, name.size());
    while (errors.ends_with('\n'))
        errors.pop_back();
    return errors;
}

}  // namespace

void require_scipfit() {
    const std::filesystem::path scipfit = program_beside("scipfit");
    if (!std::filesystem::exists(scipfit))
        throw WrongInput("scipfit, which fits the twin, is not there (" + scipfit.string() +
                         "): install the package scipd-tools anew, or build scipfit");
}

std::string run_scipfit(const std::vector<std::string>& words) {
    constexpr int wrong_input = 2;
    std::vector<std::string> command{program_beside("scipfit")};
    command.insert(command.end(), words.begin(), words.end());
    const TemporaryFolder folder("scipcat-fit");
    Interruption interruption;
    ChildProgram scipfit(command, folder.path(), "scipfit");
    const int exit_code = wait_for(scipfit, interruption);
    if (exit_code == 0) return scipfit.output();
    const std::string errors = sentence_of(scipfit.errors());
    if (exit_code == wrong_input) throw WrongInput(errors);
    throw std::runtime_error(errors.empty() ? "scipfit ended with " + std::to_string(exit_code)
                                            : errors);
}

}  // namespace scipd::tools
