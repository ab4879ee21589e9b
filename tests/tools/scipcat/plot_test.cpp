// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A picture is measured, not compared: where its walls are, how many points it has.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <cairo.h>
#include <gmock/gmock.h>

#include "daemon/models/model_registry.h"
#include "tests/support/temp_dir.h"
#include "tests/tools/scipcat/room.h"
#include "tests/tools/scipcat/scipcat.h"

namespace scipd::tests {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Extent {
    int left = 1 << 20;
    int right = -1;
    int top = 1 << 20;
    int bottom = -1;

    [[nodiscard]] double shape() const {
        return static_cast<double>(right - left) / (bottom - top);
    }
};

class Picture {
  public:
    explicit Picture(const std::filesystem::path& file)
        : surface_(cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy) {}

    [[nodiscard]] bool good() const {
        return cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS;
    }
    [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_.get()); }
    [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_.get()); }
    /// Where everything in this colour, 0xRRGGBB, or very nearly, lies.
    [[nodiscard]] Extent extent_of(std::uint32_t colour) const {
        Extent extent;
        for (int y = 0; y < height(); ++y) {
            for (int x = 0; x < width(); ++x) {
                if (!alike(pixel(x, y), colour)) continue;
                extent = {std::min(extent.left, x), std::max(extent.right, x),
                          std::min(extent.top, y), std::max(extent.bottom, y)};
            }
        }
        return extent;
    }

  private:
    static bool alike(std::uint32_t a, std::uint32_t b) {
        constexpr int tolerance = 3;
        for (const unsigned shift : {0U, 8U, 16U}) {
            const int difference =
                static_cast<int>(a >> shift & 0xFFU) - static_cast<int>(b >> shift & 0xFFU);
            if (std::abs(difference) > tolerance) return false;
        }
        return true;
    }
    [[nodiscard]] std::uint32_t pixel(int x, int y) const {
        const unsigned char* const row = cairo_image_surface_get_data(surface_.get()) +
                                         y * cairo_image_surface_get_stride(surface_.get());
        return reinterpret_cast<const std::uint32_t*>(row)[x];
    }

    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

constexpr std::uint32_t wall_colour = 0x0D4A8C;
constexpr std::uint32_t scanner_colour = 0xDB4521;

TEST(ScipcatPlot, DrawsAPng) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.png";
    const Outcome outcome = run_scipcat({"plot", scanner.tcp_target(), "-o", file});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(read_file(file), StartsWith("\x89PNG\r\n\x1A\n"));

    const Picture picture(file);
    ASSERT_TRUE(picture.good());
    EXPECT_GE(picture.width(), 1000);
    EXPECT_GE(picture.height(), 1000);

    // The room is 6 m wide and 6 m long; the scanner sits in the middle, 4 m below the upper wall.
    const Extent walls = picture.extent_of(wall_colour);
    EXPECT_NEAR(walls.shape(), 1.0, 0.01);
    EXPECT_GT(walls.right - walls.left, picture.width() * 0.7);
    const Extent mark = picture.extent_of(scanner_colour);
    EXPECT_NEAR(mark.left + mark.right, walls.left + walls.right, 6);
    const double units_per_m = (walls.right - walls.left) / 6.0;
    EXPECT_NEAR((mark.top + mark.bottom) / 2.0, walls.top + 4.0 * units_per_m, 0.1 * units_per_m);
}

TEST(ScipcatPlot, DrawsAnSvgWithEveryPoint) {
    const auto& profile = daemon::find_model("UST-10LX").profile;
    const RoomScanner scanner(profile);
    const TempDir directory;
    const auto file = directory.path() / "room.svg";
    const Outcome outcome = run_scipcat({"plot", scanner.tty(), "-o", file});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;

    std::string svg = read_file(file);
    EXPECT_THAT(svg, StartsWith("<?xml"));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    // A point is a filled path in the colour of walls; how cairo spells that depends on its age.
    std::erase(svg, ' ');
    int points = 0;
    for (std::size_t at = svg.find("<path"); at != std::string::npos;
         at = svg.find("<path", at + 1)) {
        const std::string_view path = std::string_view(svg).substr(at, svg.find('>', at) - at);
        const bool filled = path.find("fill:rgb(5%,29%,55%)") != path.npos ||
                            path.find("fill=\"rgb(5%,29%,55%)\"") != path.npos;
        points += filled ? 1 : 0;
    }
    EXPECT_EQ(points, room_points(profile));
}

TEST(ScipcatPlot, LeavesTextInAnSvgAsText) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.svg";
    const Outcome outcome =
        run_scipcat({"plot", scanner.tcp_target(), "-o", file, "--title", "A & <B>"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string svg = read_file(file);
    for (const char* const text :
         {">A &amp; &lt;B&gt;<", ">1 m<", ">x<", ">y<", "1012 points in 1081 directions"})
        EXPECT_THAT(svg, HasSubstr(text));
    EXPECT_THAT(svg, Not(HasSubstr("glyph")));
    const Outcome wrong =
        run_scipcat({"plot", scanner.tcp_target(), "-o", file, "--title", "no UTF-8: \xff"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("cannot write"));
}

TEST(ScipcatPlot, ColoursIntensities) {
    const RoomScanner scanner(daemon::find_model("UTM-30LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.png";
    const Outcome outcome = run_scipcat(
        {"plot", scanner.tcp_target(), "-o", file, "--intensity", "--title", "Intensities"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Picture picture(file);
    ASSERT_TRUE(picture.good());
    EXPECT_EQ(picture.extent_of(wall_colour).right, -1);
    constexpr std::uint32_t strongest = 0xFDE725;
    EXPECT_GT(picture.extent_of(strongest).right, 0);
}

TEST(ScipcatPlot, ColoursDistances) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    const TempDir directory;
    const auto file = directory.path() / "room.png";
    const Outcome outcome =
        run_scipcat({"plot", scanner.tcp_target(), "-o", file, "--color", "distance"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Picture picture(file);
    ASSERT_TRUE(picture.good());
    EXPECT_EQ(picture.extent_of(wall_colour).right, -1);
    // Nearest is the wall behind the scanner, and farthest are the two corners ahead; the legend is
    // above them.
    constexpr std::uint32_t nearest = 0x440154;
    constexpr std::uint32_t farthest = 0xFDE725;
    EXPECT_GT(picture.extent_of(nearest).bottom, picture.extent_of(farthest).bottom);
}

TEST(ScipcatPlot, AsksForIntensitiesToColourThem) {
    const RoomScanner scanner(daemon::find_model("UTM-30LX").profile);
    const Outcome outcome = run_scipcat({"plot", scanner.tcp_target(), "--color", "intensity"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\x1b[38;5;"));
    EXPECT_THAT(outcome.out, HasSubstr("intensity, logarithmic: "));
}

TEST(ScipcatPlot, NeedsAScipdForTheTruth) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    const Outcome outcome = run_scipcat(
        {"plot", scanner.tcp_target(), "--color", "material", "--control", "/no/such.sock"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("cannot reach scipd at /no/such.sock"));
    const Outcome unknown = run_scipcat({"plot", scanner.tcp_target(), "--color", "smell"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("--color"));
}

TEST(ScipcatPlot, DrawsInTheTerminal) {
    const RoomScanner scanner(daemon::find_model("UST-10LX").profile);
    setenv("COLUMNS", "60", 1);
    const Outcome outcome = run_scipcat({"plot", scanner.tcp_target()});
    unsetenv("COLUMNS");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith("UST-10LX\n"));
    EXPECT_THAT(outcome.out, HasSubstr("▲"));
    EXPECT_THAT(outcome.out, HasSubstr("1012 points in 1081 directions"));
    EXPECT_THAT(outcome.out, HasSubstr("┤ 1 m\n"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b")));
    // Braille dots take three bytes each; nothing but the text below may be wider than asked.
    std::size_t start = 0;
    for (std::size_t end; (end = outcome.out.find('\n', start)) != std::string::npos;
         start = end + 1) {
        const std::string line = outcome.out.substr(start, end - start);
        if (line.find("·") != line.npos) continue;
        const auto characters = std::ranges::count_if(
            line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
        EXPECT_LE(characters, 60) << line;
    }
}

TEST(ScipcatPlot, DrawsNothingOfAnEmptyWorld) {
    const auto& profile = daemon::find_model("UST-10LX").profile;
    const LoopbackScanner scanner(
        profile, [&](int) { return Reading{.distance_mm = profile.codes.nothing}; });
    const TempDir directory;
    const auto file = directory.path() / "void.png";
    const Outcome outcome = run_scipcat({"plot", scanner.tcp_target(), "-o", file});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Picture picture(file);
    ASSERT_TRUE(picture.good());
    EXPECT_EQ(picture.extent_of(wall_colour).right, -1);
    EXPECT_GT(picture.extent_of(scanner_colour).right, 0);
}

}  // namespace
}  // namespace scipd::tests
