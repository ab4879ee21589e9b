// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/service/logging.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <memory>
#include <mutex>
#include <semaphore>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>
#include <spdlog/async.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <syslog.h>

#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

using Thread = spdlog::details::thread_pool;

constexpr std::chrono::seconds patience{1};

/// What somebody else has written can neither do harm there nor pass for a line of the log.
std::string fit_for_terminals(spdlog::string_view_t payload) {
    std::string text = sim::shown({payload.data(), payload.size()});
    constexpr std::string_view indent = "    ";
    for (auto end = text.find('\n'); end != text.npos; end = text.find('\n', end + 1))
        text.insert(end + 1, indent);
    return text;
}

/// As syslog(3) has it.
int priority_of(spdlog::level::level_enum level) {
    switch (level) {
        case spdlog::level::critical:
            return LOG_CRIT;
        case spdlog::level::err:
            return LOG_ERR;
        case spdlog::level::warn:
            return LOG_WARNING;
        case spdlog::level::info:
            return LOG_INFO;
        default:
            return LOG_DEBUG;
    }
}

/// Standard error, or the journal behind it; on the thread that writes. Never made
/// unblocking: other programs share it.
class Sink : public spdlog::sinks::ansicolor_stderr_sink_mt {
  public:
    using Base = spdlog::sinks::ansicolor_stderr_sink_mt;

    explicit Sink(LogFormat format) : format_(format) {}

    void watch(std::weak_ptr<Thread> thread) { thread_ = std::move(thread); }
    /// Any thread.
    void know(const std::vector<std::string>& sensors) {
        const std::lock_guard lock(sensors_mutex_);
        sensors_.insert(sensors.begin(), sensors.end());
    }

    void log(const spdlog::details::log_msg& line) override {
        tell_what_was_lost();
        write(line);
    }

    void flush() override {
        tell_what_was_lost();
        Base::flush();
        flushed_.release();
    }
    /// Once for each flush() that was asked for.
    [[nodiscard]] bool flushed() { return flushed_.try_acquire_for(patience); }

  private:
    void write(const spdlog::details::log_msg& line) {
        if (format_ == LogFormat::journal && write_to_journal(entry(line))) return;
        const std::string text =
            format_ == LogFormat::json ? json(line) : fit_for_terminals(line.payload);
        spdlog::details::log_msg fit = line;
        fit.payload = text;
        Base::log(fit);
    }

    std::string json(const spdlog::details::log_msg& line) {
        const auto level = spdlog::level::to_string_view(line.level);
        const std::lock_guard lock(sensors_mutex_);
        return json_log_line({.time = line.time,
                              .level = {level.data(), level.size()},
                              .message = {line.payload.data(), line.payload.size()}},
                             sensors_);
    }

    JournalEntry entry(const spdlog::details::log_msg& line) {
        const std::lock_guard lock(sensors_mutex_);
        const std::string_view message{line.payload.data(), line.payload.size()};
        return {.priority = priority_of(line.level),
                .message = sim::shown(message),
                .sensor = std::string{sensor_of(message, sensors_)}};
    }

    void tell_what_was_lost() {
        const auto thread = thread_.lock();
        const std::size_t lost = thread ? thread->overrun_counter() : told_;
        const std::size_t untold = lost - std::exchange(told_, lost);
        if (untold == 0) return;
        const std::string text = std::to_string(untold) + (untold == 1 ? " line of log was lost"
                                                                       : " lines of log were lost");
        write({"scipd", spdlog::level::warn, text});
    }

    LogFormat format_;
    std::mutex sensors_mutex_;
    Sensors sensors_;
    std::weak_ptr<Thread> thread_;
    std::size_t told_ = 0;
    std::counting_semaphore<> flushed_{0};
};

struct Log {
    std::shared_ptr<Thread> thread;
    std::shared_ptr<Sink> sink;
};

/// Never destroyed, since that waits for the thread, which may wait for ever.
Log& the_log() {
    static Log& log = *new Log;
    return log;
}

using Json = nlohmann::ordered_json;

constexpr std::string_view separator = ": ";

/// RFC 3339, to the millisecond.
std::string in_utc(std::chrono::system_clock::time_point time) {
    const auto since = time.time_since_epoch();
    const auto whole = std::chrono::floor<std::chrono::seconds>(since);
    const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(since - whole);
    const auto seconds = static_cast<std::time_t>(whole.count());
    std::tm utc{};
    ::gmtime_r(&seconds, &utc);
    std::array<char, 32> text{};
    const std::size_t size = std::strftime(text.data(), text.size(), "%FT%T", &utc);
    std::snprintf(text.data() + size, text.size() - size, ".%03dZ", static_cast<int>(rest.count()));
    return text.data();
}

}  // namespace

void start_logging(const std::string& level, LogFormat format, std::size_t most_waiting) {
    const auto parsed = spdlog::level::from_str(level);
    if (parsed == spdlog::level::off && level != "off") {
        throw std::invalid_argument("there is no log level \"" + level +
                                    "\"; use trace, debug, info, warning, error, critical or off");
    }
    the_log() = {std::make_shared<Thread>(most_waiting, 1), std::make_shared<Sink>(format)};
    const auto& [thread, sink] = the_log();
    sink->watch(thread);
    spdlog::set_default_logger(std::make_shared<spdlog::async_logger>(
        "scipd", sink, thread, spdlog::async_overflow_policy::overrun_oldest));
    spdlog::set_pattern(format == LogFormat::json ? "%v" : "%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    spdlog::set_level(parsed);
}

void tell_log_of(const std::vector<std::string>& sensors) {
    if (const auto& sink = the_log().sink) sink->know(sensors);
}

bool finish_logging() {
    auto& [thread, sink] = the_log();
    if (!thread) return true;
    spdlog::default_logger_raw()->flush();
    if (!sink->flushed()) return false;
    thread.reset();
    return true;
}

std::string_view sensor_of(std::string_view message, const Sensors& sensors) {
    const std::string_view name = message.substr(0, message.find(separator));
    return name.size() < message.size() && sensors.contains(name) ? name : std::string_view{};
}

std::string json_log_line(const LogEntry& entry, const Sensors& sensors) {
    Json line{{"time", in_utc(entry.time)}, {"level", entry.level}};
    std::string_view message = entry.message;
    if (const std::string_view sensor = sensor_of(message, sensors); !sensor.empty()) {
        line["sensor"] = sensor;
        message.remove_prefix(sensor.size() + separator.size());
    }
    line["message"] = message;
    constexpr bool ascii = true;
    return line.dump(-1, ' ', ascii, Json::error_handler_t::replace);
}

}  // namespace scipd::daemon
