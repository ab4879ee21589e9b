// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/api/view_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <variant>
#include <vector>

#include "daemon/api/documents.h"
#include "daemon/api/measurement_text.h"

namespace scipd::daemon {
namespace {

static_assert(std::endian::native == std::endian::little, "pages read little-endian");

constexpr std::string_view magic = "SCV1";
constexpr std::size_t word = 4;

template <class Number>
constexpr std::string_view type_of() {
    if constexpr (std::is_same_v<Number, float>) return "f32";
    if constexpr (std::is_same_v<Number, std::int32_t>) return "i32";
    if constexpr (std::is_same_v<Number, std::uint32_t>) return "u32";
    if constexpr (std::is_same_v<Number, std::int16_t>) return "i16";
    if constexpr (std::is_same_v<Number, std::uint16_t>) return "u16";
    if constexpr (std::is_same_v<Number, std::uint8_t>) return "u8";
}

void append_word(std::string& bytes, std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    bytes.append(reinterpret_cast<const char*>(&number), word);
}

void fill_word(std::string& bytes, char with) {
    bytes.append((word - bytes.size() % word) % word, with);
}

/// The header and the arrays, as they come.
class Frame {
  public:
    explicit Frame(Json header) : header_(std::move(header)), arrays_(Json::array()) {}

    Json& header() { return header_; }

    template <class Number>
    void add(std::string_view name, const std::vector<Number>& list) {
        arrays_.push_back({{"name", name}, {"type", type_of<Number>()}, {"length", list.size()}});
        content_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(Number));
        fill_word(content_, '\0');
    }
    /// `get(i)` for each of so many elements.
    template <class Number, class Get>
    void add(std::string_view name, std::size_t size, Get get) {
        std::vector<Number> list(size);
        for (std::size_t i = 0; i < size; ++i)
            list[i] = get(i);
        add(name, list);
    }

    [[nodiscard]] std::string finish() && {
        header_["arrays"] = std::move(arrays_);
        std::string text = text_of(header_);
        fill_word(text, ' ');
        std::string bytes(magic);
        append_word(bytes, 0);
        append_word(bytes, text.size());
        bytes.reserve(bytes.size() + text.size() + content_.size());
        return bytes.append(text).append(content_);
    }

  private:
    Json header_;
    Json arrays_;
    std::string content_;
};

/// Numbers the materials of a measurement, of which a world has many more.
class Palette {
  public:
    explicit Palette(const sim::Scene& scene) : scene_(scene) {}

    /// The number of the material of an object; -1 for nothing, and for something in the air.
    std::int16_t of(const auto& thing) {
        if (thing.object == sim::no_object) return -1;
        const auto [known, is_new] =
            number_.try_emplace(thing.material, static_cast<std::int16_t>(number_.size()));
        if (is_new) names_.push_back(scene_.materials[thing.material].name);
        return known->second;
    }
    [[nodiscard]] const Json& names() const { return names_; }

  private:
    const sim::Scene& scene_;
    std::map<sim::MaterialId, std::int16_t> number_;
    Json names_ = Json::array();
};

/// Where the sensor was while it moved: at so many places at most, each for as many beams. xyz is
/// from the place in the header, so that a float is exact enough however far the world's origin is.
void add_poses(Frame& frame, const sim::Scan& scan) {
    constexpr std::size_t most = 64;
    const auto& poses = scan.world_from_sensor;
    const sim::Pose& middle = poses[poses.size() / 2];
    frame.header()["pose"] = pose_document(middle);
    const bool moves = std::ranges::any_of(poses, [&](const auto& pose) { return pose != middle; });
    const std::size_t count = moves ? std::min(most, poses.size()) : 1;
    frame.header()["poses_n"] = count;
    if (!moves) return;
    std::vector<float> numbers;
    for (std::size_t i = 0; i < count; ++i) {
        const sim::Pose& pose = poses[(2 * i + 1) * poses.size() / (2 * count)];
        const glm::dvec3 from_middle = pose.translation_m - middle.translation_m;
        const glm::dquat& q = pose.rotation;
        for (const double x : {from_middle.x, from_middle.y, from_middle.z, q.x, q.y, q.z, q.w})
            numbers.push_back(static_cast<float>(x));
    }
    frame.add("origin_pose", numbers);
}

/// A page draws what is not there as NaN.
float drawn_m(float range_m) {
    return std::isfinite(range_m) ? range_m : std::numeric_limits<float>::quiet_NaN();
}

/// What returned the light of a beam: of the echoes that came back, the one nearest to what was
/// read, which may be of a wall behind glass. Null: none came back.
const sim::Echo* returned(const sim::Scan& scan, std::size_t beam) {
    const float read_m = scan.readings[beam].range_m;
    const auto echoes = scan.echoes[beam];
    const auto nearest = std::ranges::min_element(
        echoes, {}, [&](const sim::Echo& echo) { return std::abs(echo.range_m - read_m); });
    return nearest == echoes.end() ? nullptr : &*nearest;
}

void add_returned(Frame& frame, const sim::Scan& scan, Palette& palette) {
    frame.add<float>("returned_m", scan.beams(), [&](std::size_t beam) {
        const sim::Echo* const echo = returned(scan, beam);
        return drawn_m(echo != nullptr ? echo->range_m : scan.middle(beam).range_m);
    });
    frame.add<std::int16_t>("returned_material", scan.beams(), [&](std::size_t beam) {
        const sim::Echo* const echo = returned(scan, beam);
        return echo != nullptr ? palette.of(*echo) : palette.of(scan.middle(beam));
    });
}

void add_truth(Frame& frame, const Measurement& record) {
    const sim::Scan& scan = *record.cast;
    Palette palette(*record.scene);
    frame.add<float>("true_m", scan.beams(),
                     [&](std::size_t beam) { return drawn_m(scan.middle(beam).range_m); });
    frame.add<std::int16_t>("material", scan.beams(),
                            [&](std::size_t beam) { return palette.of(scan.middle(beam)); });
    // no_object is -1.
    frame.add<std::int32_t>("object", scan.beams(), [&](std::size_t beam) {
        return static_cast<std::int32_t>(scan.middle(beam).object);
    });
    if (!scan.echoes.empty()) add_returned(frame, scan, palette);
    frame.header()["materials"] = palette.names();
}

Frame frame_of(const std::string& sensor, const Measurement& record, std::string_view kind) {
    const sim::Scan& scan = *record.cast;
    Frame frame(Json{{"sensor", sensor},
                     {"kind", kind},
                     {"scan", scan.revolution},
                     {"time_s", seconds(record.told(scan.start))},
                     {"beams", scan.beams()}});
    add_poses(frame, scan);
    return frame;
}

/// By the numbers of the causes.
Json cause_words() {
    Json words = Json::array();
    for (int cause = 0; cause <= static_cast<int>(sim::Cause::lost); ++cause)
        words.push_back(cause_word(static_cast<sim::Cause>(cause)));
    return words;
}

std::uint16_t narrow(std::uint32_t intensity) {
    return static_cast<std::uint16_t>(std::min<std::uint32_t>(intensity, 0xFFFF));
}

void add_identity(Json& header, const ScannerIdentity& scanner) {
    constexpr double mm_per_m = 1000.0;
    header["model"] = scanner.model;
    header["serial"] = scanner.serial;
    header["firmware"] = scanner.firmware;
    header["dmin_mm"] = scanner.dmin_mm;
    header["nearest_mm"] = scanner.nearest_mm;
    header["dmax_mm"] = scanner.farthest_mm;
    header["max_range_m"] = scanner.farthest_mm / mm_per_m;
    header["rpm"] = scanner.rpm;
}

/// Runs of consecutive steps: [[first, last], ..].
Json runs_of(const std::vector<int>& steps) {
    Json runs = Json::array();
    for (const int step : steps) {
        if (runs.empty() || runs.back()[1] != step - 1) runs.push_back({step, step});
        runs.back()[1] = step;
    }
    return runs;
}

void add_faults(Json& header, const std::vector<ReadingFault>& faults) {
    header["faults"] = Json::array();
    for (const ReadingFault& fault : faults)
        header["faults"].push_back(
            {{"kind", fault.kind}, {"what", fault.what}, {"steps", runs_of(fault.steps)}});
}

/// All echoes of a scanner that tells several: where those of each beam end, and the echoes.
void add_echoes(Frame& frame, const std::vector<protocol::StepEchoes>& steps) {
    std::vector<std::uint32_t> ends;
    std::vector<std::uint32_t> distances;
    std::vector<std::uint16_t> intensities;
    for (const protocol::StepEchoes& step : steps) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(step.count); ++i) {
            distances.push_back(step.echo[i].distance);
            intensities.push_back(narrow(step.echo[i].intensity));
        }
        ends.push_back(static_cast<std::uint32_t>(distances.size()));
    }
    frame.header()["echoes_n"] = distances.size();
    frame.add("echo_end", ends);
    frame.add("echo_mm", distances);
    frame.add("echo_intensity", intensities);
}

}  // namespace

std::string view_frame(const std::string& sensor, const ScanRecord& record,
                       const ScannerIdentity& scanner, ViewDepth depth) {
    const sim::Scan& scan = *record.cast;
    Frame frame = frame_of(sensor, record, "scan");
    const double step_rad = 2.0 * std::numbers::pi / record.steps_per_turn;
    frame.header()["stamp_ms"] = record.stamp_ms;
    frame.header()["first_angle_rad"] = (record.sent.first_step - record.front_step) * step_rad;
    frame.header()["step_rad"] = step_rad;
    frame.header()["first_step"] = record.sent.first_step;
    frame.header()["front_step"] = record.front_step;
    frame.header()["steps_per_turn"] = record.steps_per_turn;
    add_identity(frame.header(), scanner);
    frame.add("sent_mm", record.sent.distance);
    frame.add<std::uint16_t>("intensity", record.sent.intensity.size(),
                             [&](std::size_t beam) { return narrow(record.sent.intensity[beam]); });
    if (!record.sent.echoes.empty()) add_echoes(frame, record.sent.echoes);
    if (depth != ViewDepth::truth) return std::move(frame).finish();
    add_truth(frame, record);
    add_faults(frame.header(), record.faults);
    frame.header()["causes"] = cause_words();
    frame.add<std::uint8_t>("cause", scan.readings.size(), [&](std::size_t beam) {
        return static_cast<std::uint8_t>(scan.readings[beam].cause);
    });
    return std::move(frame).finish();
}

std::string view_frame(const std::string& sensor, const StaringRecord& record, ViewDepth depth) {
    const auto* const grid = std::get_if<sim::PinholeGrid>(&record.spec.optics);
    Frame frame = frame_of(sensor, record, grid != nullptr ? "picture" : "cone");
    frame.header()["max_range_m"] = record.spec.max_range_m;
    if (grid != nullptr) {
        frame.header()["columns"] = grid->columns;
        frame.header()["rows"] = grid->rows;
        frame.header()["fov_rad"] = {grid->width_rad, grid->height_rad};
    } else {
        const auto& cone = std::get<sim::RangerOptics>(record.spec.optics).cone;
        frame.header()["cone_deg"] = rounded(cone.opening_rad * 180.0 / std::numbers::pi);
        const std::vector<glm::vec3> directions = cone.directions();
        frame.add<float>("direction", 3 * directions.size(), [&](std::size_t i) {
            return directions[i / 3][static_cast<glm::length_t>(i % 3)];
        });
    }
    frame.add<float>("range_m", record.range_m.size(),
                     [&](std::size_t i) { return drawn_m(record.range_m[i]); });
    if (depth == ViewDepth::truth) add_truth(frame, record);
    return std::move(frame).finish();
}

void set_frame_number(std::string& frame, std::uint32_t number) {
    std::memcpy(frame.data() + magic.size(), &number, word);
}

}  // namespace scipd::daemon
