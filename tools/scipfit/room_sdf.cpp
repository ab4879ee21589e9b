// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include <cmath>
#include <ostream>

#include "sim/text/quote.h"
#include "tools/formatted.h"
#include "tools/scipfit/room_report.h"

namespace scipd::tools {
namespace {

constexpr double thickness_m = 0.04;
constexpr double height_m = 2.0;

/// What XML would take for the end of the comment.
std::string in_comment(std::string text) {
    for (auto at = text.find("--"); at != text.npos; at = text.find("--"))
        text.replace(at, 2, "- ");
    return text;
}

/// SDF has one number for how bright a face is: how much light it sends back (docs/materials.md).
std::string retro_of(double brightness, const sim::Receiver& receiver) {
    const bool by_logarithm = brightness > 1.0 && receiver.log_gain > 0.0;
    const double power =
        by_logarithm ? std::exp((brightness - 1.0) / receiver.log_gain) : brightness;
    return formatted("<laser_retro>%.4g</laser_retro>", power);
}

void write_wall(const Wall& wall, std::size_t number, int first_step, const std::string& retro,
                std::ostream& out) {
    const double dx = wall.end.x_m - wall.begin.x_m;
    const double dy = wall.end.y_m - wall.begin.y_m;
    const double yaw = std::atan2(dy, dx);
    // The face is what was seen; the rest of the wall lies behind it.
    const double x =
        0.5 * (wall.begin.x_m + wall.end.x_m) + 0.5 * thickness_m * std::cos(wall.normal_rad);
    const double y =
        0.5 * (wall.begin.y_m + wall.end.y_m) + 0.5 * thickness_m * std::sin(wall.normal_rad);
    const std::string box = formatted("<geometry><box><size>%.5f %.3f %.1f</size></box></geometry>",
                                      std::hypot(dx, dy), thickness_m, height_m);
    out << formatted("    <!-- measured: steps %d to %d, %.1f mm around the plane -->\n",
                     first_step + static_cast<int>(wall.first),
                     first_step + static_cast<int>(wall.last), wall.deviation_mm)
        << formatted("    <model name=\"wall_%zu\">\n", number) << "      <static>true</static>\n"
        << formatted("      <pose>%.5f %.5f 0 0 0 %.6f</pose>\n", x, y, yaw)
        << "      <link name=\"link\"><visual name=\"face\">" << box << retro
        << "</visual></link>\n"
        << "    </model>\n";
}

}  // namespace

void write_room(const Room& room, const ScanTable& readings, const daemon::Model& model,
                std::ostream& out) {
    out << "<?xml version=\"1.0\"?>\n"
        << "<!-- Made by scipfit room from " << in_comment(sim::printable(readings.files))
        << ". The scanner is at the origin and looks along x.\n";
    if (room.light)
        out << "     measured: laser_retro, beside the bright ones of these walls; how bright "
               "those "
               "are is not known.\n";
    out << formatted("     assumed: walls are %g m high and %g m thick. -->\n", height_m,
                     thickness_m)
        << "<sdf version=\"1.9\">\n  <world name=\"room\">\n";
    for (std::size_t i = 0; i < room.walls.size(); ++i) {
        const std::string retro =
            room.light ? retro_of(room.light->brightness[i], model.optics.receiver) : "";
        write_wall(room.walls[i], i, readings.step_of(0), retro, out);
    }
    out << "  </world>\n</sdf>\n";
}

}  // namespace scipd::tools
