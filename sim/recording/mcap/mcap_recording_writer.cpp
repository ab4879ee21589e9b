// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "sim/recording/json/scan_json.h"
#include "sim/recording/mcap/mcap.h"

namespace scipd::sim {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// JSON Schema of the scans: foxglove.LaserScan, and beside it what it has no room for.
constexpr std::string_view scan_schema = R"({
  "title": "foxglove.LaserScan",
  "description": "A scan of a planar laser range-finder",
  "type": "object",
  "properties": {
    "timestamp": {
      "type": "object",
      "title": "time",
      "properties": {
        "sec": {"type": "integer", "minimum": 0},
        "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}
      }
    },
    "frame_id": {"type": "string"},
    "pose": {
      "type": "object",
      "title": "foxglove.Pose",
      "properties": {
        "position": {
          "type": "object",
          "title": "foxglove.Vector3",
          "properties": {
            "x": {"type": "number"}, "y": {"type": "number"}, "z": {"type": "number"}
          }
        },
        "orientation": {
          "type": "object",
          "title": "foxglove.Quaternion",
          "properties": {
            "x": {"type": "number"}, "y": {"type": "number"},
            "z": {"type": "number"}, "w": {"type": "number"}
          }
        }
      }
    },
    "start_angle": {"type": "number", "description": "of the first range, in radians"},
    "end_angle": {"type": "number", "description": "of the last range, in radians"},
    "ranges": {
      "type": "array", "items": {"type": "number"},
      "description": "in metres, the nearest of each step; 0: no distance"
    },
    "intensities": {"type": "array", "items": {"type": "number"}},
    "stamp_ms": {"type": "integer", "description": "the scanner's clock at step 0, 24 bits"},
    "stamp_us": {"type": "integer", "description": "the same in microseconds"},
    "first_step": {"type": "integer"},
    "cluster": {"type": "integer", "description": "neighbouring steps that share a value"},
    "first_angle_rad": {"type": "number"},
    "angle_increment_rad": {"type": "number"},
    "distances_mm": {
      "type": "array", "items": {"type": "number"},
      "description": "as the scanner sent them, its codes for no distance among them"
    },
    "echoes": {
      "type": "array", "items": {"type": "array"},
      "description": "of each step all, as mm or [mm, intensity]"
    }
  }
}
)";

std::uint64_t unix_ns(HostTime time) {
    const auto ns = time.time_since_epoch().count();
    return static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 0));
}

OrderedJson timestamp(std::uint64_t ns) {
    constexpr std::uint64_t per_second = 1'000'000'000;
    return {{"sec", ns / per_second}, {"nsec", ns % per_second}};
}

/// 0 in place of what is no distance: those who show scans know no codes.
OrderedJson ranges_of(const RecordedScan& scan, const ScannerIdentity& identity) {
    OrderedJson ranges = OrderedJson::array();
    for (std::size_t step = 0; step < scan.steps(); ++step) {
        const auto values = scan.ranges_of(step);
        const double range_m = values.empty() ? 0.0 : values.front() / 1000.0;
        const bool is_distance = range_m >= identity.min_range_m.value_or(0) &&
                                 range_m <= identity.max_range_m.value_or(1e9);
        ranges.push_back(is_distance ? range_m : 0.0);
    }
    return ranges;
}

class McapRecordingWriter final : public RecordingWriter {
  public:
    McapRecordingWriter(const std::filesystem::path& path, const ScannerIdentity& identity,
                        mcap::WriterOptions options)
        : writer_(path, std::move(options)), identity_(identity) {
        const auto schema = writer_.add_schema(std::string(mcap::scan_schema_name), "jsonschema",
                                               std::string(scan_schema));
        const auto add = [&](std::string_view topic, std::uint16_t of, std::string_view encoding) {
            return writer_.add_channel(std::string(topic), of, std::string(encoding));
        };
        to_scanner_ = add(mcap::to_scanner_topic, 0, mcap::wire_encoding);
        from_scanner_ = add(mcap::from_scanner_topic, 0, mcap::wire_encoding);
        scan_ = add(mcap::scan_topic, schema, "json");
        writer_.add_metadata({std::string(mcap::metadata_name), entries_of(identity)});
    }

    void write(const RecordedScan& scan) override {
        const Directions& directions = scan.directions;
        const double first_rad = directions.first_rad.value_or(0);
        const double gaps = static_cast<double>(std::max<std::size_t>(scan.steps(), 1) - 1);
        const std::uint64_t ns = unix_ns(scan.host_time.value_or(HostTime{}));
        OrderedJson message{
            {"timestamp", timestamp(ns)},
            {"frame_id", "laser"},
            {"pose",
             {{"position", {{"x", 0}, {"y", 0}, {"z", 0}}},
              {"orientation", {{"x", 0}, {"y", 0}, {"z", 0}, {"w", 1}}}}},
            {"start_angle", first_rad},
            {"end_angle", first_rad + gaps * directions.increment_rad.value_or(0)},
            {"ranges", ranges_of(scan, identity_)},
            {"intensities", OrderedJson::array()},
        };
        add_scan(message, scan);
        writer_.write(scan_, ns, message.dump());
    }

    void write(const RecordedBytes& bytes) override {
        writer_.write(bytes.way == Way::to_scanner ? to_scanner_ : from_scanner_,
                      unix_ns(bytes.host_time), bytes.bytes);
    }

    void finish() override { writer_.finish(); }

  private:
    mcap::Writer writer_;
    ScannerIdentity identity_;
    std::uint16_t to_scanner_ = 0;
    std::uint16_t from_scanner_ = 0;
    std::uint16_t scan_ = 0;
};

}  // namespace

std::unique_ptr<RecordingWriter> create_mcap(const std::filesystem::path& path,
                                             const ScannerIdentity& identity,
                                             mcap::WriterOptions options) {
    return std::make_unique<McapRecordingWriter>(path, identity, std::move(options));
}

}  // namespace scipd::sim
