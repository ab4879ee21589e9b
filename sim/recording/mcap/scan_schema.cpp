// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/recording/mcap/scip_channels.h"

namespace scipd::sim::mcap {

const std::string_view scan_schema = R"({
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

}  // namespace scipd::sim::mcap
