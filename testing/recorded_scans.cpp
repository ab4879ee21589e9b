// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "testing/recorded_scans.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <stdexcept>

#include "testing/scan_recording.h"
#include "tools/control_client.h"

namespace scipd::testing {
namespace {

// What is nearer, or this, is a code for no distance.
constexpr std::uint32_t nearest_mm = 20;
constexpr std::uint32_t nothing_mm = 65533;

constexpr std::string_view magic("\x89MCAP0\r\n", 8);
enum Kind : std::uint8_t { header = 1, footer, schema, channel, message, data_end = 15 };

/// Numbers have their little end first.
template <class Number>
std::string bytes_of(Number number) {
    std::string bytes;
    for (std::size_t i = 0; i < sizeof number; ++i)
        bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> 8 * i & 0xFF);
    return bytes;
}

std::string text_of(std::string_view text) {
    return bytes_of(static_cast<std::uint32_t>(text.size())).append(text);
}

Json numbers() {
    return {{"type", "array"}, {"items", {{"type", "number"}}}};
}

Json parts(std::string_view names) {
    Json properties = Json::object();
    for (const char name : names)
        properties[std::string(1, name)] = {{"type", "number"}};
    return {{"type", "object"}, {"properties", properties}};
}

Json laser_scan_schema() {
    const Json integer{{"type", "integer"}};
    const Json number{{"type", "number"}};
    return {{"title", "foxglove.LaserScan"},
            {"type", "object"},
            {"properties",
             {{"timestamp",
               {{"type", "object"},
                {"title", "time"},
                {"properties", {{"sec", integer}, {"nsec", integer}}}}},
              {"frame_id", {{"type", "string"}}},
              {"pose",
               {{"title", "foxglove.Pose"},
                {"type", "object"},
                {"properties", {{"position", parts("xyz")}, {"orientation", parts("xyzw")}}}}},
              {"start_angle", number},
              {"end_angle", number},
              {"ranges", numbers()},
              {"intensities", numbers()},
              {"distances_mm", numbers()},
              {"stamp_ms", integer},
              {"first_step", integer}}}};
}

struct Turn {
    explicit Turn(const Json& told)
        : first_step(told.at("first_step")),
          step_rad(2.0 * std::numbers::pi / told.at("steps_per_turn").get<double>()),
          first_rad((first_step - told.at("front_step").get<int>()) * step_rad) {}

    int first_step;
    double step_rad;
    double first_rad;
};

/// As scipcat writes JSON lines.
Json line_of(const Json& told) {
    const Turn turn(told);
    return {{"host_time_s", told.at("time_s")},   {"serial", told.at("sensor")},
            {"stamp_ms", told.at("stamp_ms")},    {"first_step", turn.first_step},
            {"first_angle_rad", turn.first_rad},  {"angle_increment_rad", turn.step_rad},
            {"distances_mm", told.at("sent_mm")}, {"intensities", told.at("intensity")}};
}

/// foxglove.LaserScan. What is no distance reads 0 there: those who show scans know no codes.
Json laser_scan(const Json& told) {
    const Turn turn(told);
    const double time_s = told.at("time_s");
    const double whole_s = std::floor(time_s);
    const Json& xyz = told.at("pose").at("xyz");
    const Json& q = told.at("pose").at("q");
    const Json& sent = told.at("sent_mm");
    Json ranges = Json::array();
    for (const Json& one : sent) {
        const std::uint32_t mm = one;
        ranges.push_back(mm >= nearest_mm && mm != nothing_mm ? mm / 1000.0 : 0.0);
    }
    return {{"timestamp",
             {{"sec", std::llround(whole_s)}, {"nsec", std::llround((time_s - whole_s) * 1e9)}}},
            {"frame_id", "world"},
            {"pose",
             {{"position", {{"x", xyz[0]}, {"y", xyz[1]}, {"z", xyz[2]}}},
              {"orientation", {{"x", q[0]}, {"y", q[1]}, {"z", q[2]}, {"w", q[3]}}}}},
            {"start_angle", turn.first_rad},
            {"end_angle",
             turn.first_rad + (std::max<double>(double(sent.size()), 1) - 1) * turn.step_rad},
            {"ranges", ranges},
            {"intensities", told.at("intensity")},
            {"distances_mm", sent},
            {"stamp_ms", told.at("stamp_ms")},
            {"first_step", turn.first_step}};
}

std::string stream_of(const std::string& sensor) {
    return sensor.empty() ? "/stream" : "/stream?sensor=" + tools::path_segment(sensor);
}

}  // namespace

ScanFile::ScanFile(const std::filesystem::path& path) : is_mcap_(path.extension() == ".mcap") {
    if (!is_mcap_ && path.extension() != ".jsonl")
        throw std::invalid_argument(path.string() + ": a recording ends with .mcap or .jsonl");
    file_.open(path, std::ios::binary | std::ios::trunc);
    if (!file_) throw ScipdError(path.string() + " cannot be written");
    if (!is_mcap_) return;
    file_ << magic;
    put(header, text_of("") + text_of("scipd"));
    put(schema, bytes_of(std::uint16_t{1}) + text_of("foxglove.LaserScan") + text_of("jsonschema") +
                    text_of(laser_scan_schema().dump()));
}

void ScanFile::write(const std::string& text) {
    const Json told = Json::parse(text);
    if (!told.contains("sent_mm")) return;  // a fault, or what a camera or a ranger reads
    ++scans_;
    is_mcap_ ? write_mcap(told) : void(file_ << line_of(told).dump() << '\n');
    file_.flush();
}

void ScanFile::write_mcap(const Json& told) {
    const std::string topic = "/" + told.at("sensor").get<std::string>() + "/scan";
    const auto next = static_cast<std::uint16_t>(channels_.size() + 1);
    const auto [place, is_new] = channels_.try_emplace(topic, next);
    if (is_new) {
        put(channel, bytes_of(next) + bytes_of(std::uint16_t{1}) + text_of(topic) +
                         text_of("json") + bytes_of(std::uint32_t{0}));
    }
    const double time_s = told.at("time_s");
    const std::string time = bytes_of(std::llround(std::max(0.0, time_s) * 1e9));
    put(message, bytes_of(place->second) + bytes_of(std::uint32_t{0}) + time + time +
                     laser_scan(told).dump());
}

void ScanFile::finish() {
    if (is_mcap_) {
        put(data_end, bytes_of(std::uint32_t{0}));
        put(footer,
            bytes_of(std::uint64_t{0}) + bytes_of(std::uint64_t{0}) + bytes_of(std::uint32_t{0}));
        file_ << magic;
    }
    file_.close();
}

void ScanFile::put(std::uint8_t kind, std::string_view content) {
    file_ << static_cast<char>(kind) << bytes_of(std::uint64_t{content.size()}) << content;
}

ScanRecorder::ScanRecorder(const std::string& control, const std::filesystem::path& path,
                           const std::string& sensor)
    : file_(path),
      listener_(
          std::make_unique<Listener>(control, stream_of(sensor), [this](const std::string& told) {
              const std::lock_guard lock(mutex_);
              file_.write(told);
          })) {}

void ScanRecorder::catch_up() const {
    if (listener_) listener_->catch_up();
}

std::size_t ScanRecorder::scans() const {
    const std::lock_guard lock(mutex_);
    return file_.scans();
}

void ScanRecorder::stop() {
    if (!listener_) return;
    listener_.reset();
    file_.finish();
}

std::size_t Recording::scans() const {
    return recorder_->scans();
}

void Recording::stop() const {
    recorder_->stop();
}

LastScans::LastScans(const std::string& control, std::chrono::duration<double> seconds)
    : seconds_(seconds.count()),
      listener_(control, stream_of({}), [this](const std::string& told) { hear(told); }) {}

void LastScans::hear(const std::string& told) {
    const Json read = Json::parse(told);
    if (!read.contains("time_s")) return;
    const double time_s = read.at("time_s");
    const std::lock_guard lock(mutex_);
    kept_.push_back({time_s, told});
    while (kept_.front().time_s < time_s - seconds_)
        kept_.pop_front();
}

void LastScans::save(const std::filesystem::path& path) const {
    const std::lock_guard lock(mutex_);
    ScanFile file(path);
    for (const Kept& kept : kept_)
        file.write(kept.told);
    file.finish();
}

}  // namespace scipd::testing
