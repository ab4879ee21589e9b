// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The program scipd: options, a server, and how it ends. On the main thread, which is the I/O
// thread.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <variant>

#include <fcntl.h>
#include <malloc.h>
#include <spdlog/spdlog.h>
#include <syslog.h>
#include <unistd.h>

#include "daemon/config/address.h"
#include "daemon/program/parse_options.h"
#include "daemon/server.h"
#include "daemon/service/logging.h"
#include "daemon/service/service_notify.h"
#include "sim/backends/depth.h"
#include "sim/text/quote.h"

namespace {

// Where a standard descriptor is closed, the next file that is opened takes its number, and would
// be read and written in its place.
void open_standard_descriptors() {
    int descriptor = 0;
    while (descriptor >= 0 && descriptor <= STDERR_FILENO)
        descriptor = ::open("/dev/null", O_RDWR);
    if (descriptor >= 0) ::close(descriptor);
}

// The C library raises both with the largest piece that is ever freed, and so would keep 64 MB of
// a large world for each thread that has had to do with it. A picture's scans stay below the first.
void keep_little_memory() {
    constexpr int megabyte = 1 << 20;
    ::mallopt(M_MMAP_THRESHOLD, 8 * megabyte);
    ::mallopt(M_TRIM_THRESHOLD, 16 * megabyte);
}

// Standard output carries the ready line and answers to questions; nothing else.
void print(const std::string& text, std::FILE* stream = stdout) {
    std::fputs(text.c_str(), stream);
    std::fflush(stream);
}

void print_error(const std::exception& error) {
    print(scipd::sim::shown(error.what()) + "\n", stderr);
}

void tell_systemd_of_no_start(const std::string& why) {
    scipd::daemon::service_notify::status("cannot start: " + why);
}

/// What is wrong with the options or the configuration, as there is no log yet.
void print_refusal(const std::string& text) {
    const std::string why = text.substr(0, text.find_last_not_of('\n') + 1);
    tell_systemd_of_no_start(why);
    const bool to_journal = scipd::daemon::leads_to_journal(STDERR_FILENO);
    if (!to_journal || !scipd::daemon::write_to_journal({.priority = LOG_CRIT, .message = why}))
        print(text, stderr);
}

/// The kernel lets the first process of a container ignore signals that it does not handle.
void end_as_others_end() {
    constexpr pid_t first_process = 1;
    if (::getpid() != first_process) return;
    for (const int signal : {SIGINT, SIGTERM})
        std::signal(signal, [](int ended_by) { ::_exit(128 + ended_by); });
}

enum ExitCode {
    ended_as_asked = 0,
    failed = 1,  ///< and may do better when it is started again
    cannot_start = 2,
};

using scipd::daemon::LogFormat;

LogFormat log_format(const scipd::daemon::Options& options) {
    if (options.log_format == "json") return LogFormat::json;
    return scipd::daemon::leads_to_journal(STDERR_FILENO) ? LogFormat::journal : LogFormat::text;
}

ExitCode exit_code_of(const std::exception& no_start) {
    const bool may_come = dynamic_cast<const scipd::daemon::NotThereYet*>(&no_start) != nullptr;
    return may_come ? failed : cannot_start;
}

int serve(const scipd::daemon::Options& options) {
    std::optional<scipd::daemon::Server> server;
    try {
        server.emplace(options);
    } catch (const std::exception& error) {
        tell_systemd_of_no_start(error.what());
        if (log_format(options) != LogFormat::text && options.log_level != "off") {
            spdlog::critical("{}", error.what());
        } else if (scipd::daemon::finish_logging()) {
            print_error(error);
        }
        return exit_code_of(error);
    }
    print(server->ready_line() + "\n");
    try {
        server->run();
    } catch (const std::exception& error) {
        spdlog::critical("{}", error.what());
        return failed;
    }
    return ended_as_asked;
}

int run(const scipd::daemon::Options& options) {
    try {
        scipd::daemon::start_logging(options.log_level, log_format(options));
    } catch (const std::exception& error) {
        print_error(error);
        return cannot_start;
    }
    const int exit_code = serve(options);
    // Whoever does not read the log does not keep scipd from ending.
    if (!scipd::daemon::finish_logging()) std::_Exit(exit_code);
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    end_as_others_end();
    open_standard_descriptors();
    keep_little_memory();
    // A client that goes away is an error of one write, not the end of the program.
    std::signal(SIGPIPE, SIG_IGN);
    scipd::sim::prepare_drivers();
    auto parsed = scipd::daemon::parse_options(argc, argv);
    if (const auto* answer = std::get_if<scipd::daemon::Answer>(&parsed)) {
        const std::string text = scipd::sim::shown(answer->text);
        if (answer->exit_code == cannot_start) {
            print_refusal(text);
        } else {
            print(text);
        }
        return answer->exit_code;
    }
    return run(std::get<scipd::daemon::Options>(std::move(parsed)));
}
