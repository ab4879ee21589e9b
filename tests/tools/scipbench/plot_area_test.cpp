// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Pictures of scipbench as they come out: where there is ink, and where there must be none.
#include "tools/scipbench/plot_area.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <cairo.h>
#include <gtest/gtest.h>

#include "tests/support/child.h"
#include "tests/support/temp_dir.h"

namespace scipd::tools {
namespace {

/// In pixels.
struct Box {
    int left;
    int top;
    int right;
    int bottom;
};

class Picture {
  public:
    explicit Picture(const std::filesystem::path& file)
        : surface_(cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy) {
        EXPECT_EQ(cairo_surface_status(surface_.get()), CAIRO_STATUS_SUCCESS);
    }

    [[nodiscard]] int width() const { return cairo_image_surface_get_width(surface_.get()); }
    [[nodiscard]] int height() const { return cairo_image_surface_get_height(surface_.get()); }

    /// Around all that is not the colour of the corner.
    [[nodiscard]] Box ink() const {
        Box box{width(), height(), 0, 0};
        for (int y = 0; y < height(); ++y) {
            for (int x = 0; x < width(); ++x) {
                if (pixel(x, y) == pixel(0, 0)) continue;
                box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
                       std::max(box.bottom, y)};
            }
        }
        return box;
    }

  private:
    [[nodiscard]] std::uint32_t pixel(int x, int y) const {
        const unsigned char* const row = cairo_image_surface_get_data(surface_.get()) +
                                         y * cairo_image_surface_get_stride(surface_.get());
        std::uint32_t pixel = 0;
        std::memcpy(&pixel, row + x * 4, 4);
        return pixel & 0xFFFFFFU;
    }

    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

class PlotAreaTest : public testing::Test {
  protected:
    Picture drawn(const std::string& title, const std::string& below, int legend_lines,
                  bool grid = true) {
        Page page(file_, PlotArea::page_height(static_cast<std::size_t>(legend_lines)));
        PlotArea area(page, {1.0, 1e5, true}, {0.0, 10.0, false});
        area.title(title, below);
        if (grid) area.grid("rays", "ms");
        for (int i = 0; i < legend_lines; ++i)
            area.legend("RwM of this machine", colours::wall, 1.0, false);
        EXPECT_EQ(page.finish(), std::nullopt);
        return Picture(file_);
    }

    tests::TempDir directory_;
    std::filesystem::path file_ = directory_.path() / "picture.png";
};

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

// One of 200 characters is about what there is.
TEST_F(PlotAreaTest, KeepsTitlesOfAnyLengthOnThePage) {
    const int right = drawn("", "", 0).ink().right;  // of the frame
    for (const int length : {10, 20, 40, 100}) {
        for (const std::string& word : {std::string("12th Gen. "), std::string("0123456789")}) {
            const std::string text = repeated(word, length);
            const Box ink = drawn(text, text, 0, false).ink();
            EXPECT_LE(ink.right, right) << text;
            EXPECT_GE(ink.right, right / 10) << text;
        }
    }
}

TEST_F(PlotAreaTest, LeavesTheTitleAboveTheFrame) {
    const std::string text = repeated("12th Gen. ", 30);
    const int title_bottom = drawn(text, text, 0, false).ink().bottom;
    const int frame_title_top = drawn("", "", 0).ink().top;
    EXPECT_LT(title_bottom, frame_title_top);
}

/// Where the texts of an SVG stand, as wide and as high as cairo writes them.
std::vector<cairo_rectangle_t> texts_of(const std::filesystem::path& svg) {
    const std::regex text(
        R"re(<text xml:space="preserve" x="([^"]+)" y="([^"]+)".*? font-size="([^"]+)")re"
        R"re([^>]*?(text-anchor="(middle|end)")?>([^<]+)<)re");
    const std::string all = tests::read_file(svg);
    std::vector<cairo_rectangle_t> boxes;
    Page page(svg.parent_path() / "measure.png");
    for (std::sregex_iterator it(all.begin(), all.end(), text), end; it != end; ++it) {
        const std::smatch& found = *it;
        const double size = std::stod(found[3]);
        const double length = page.length_of(found[6], size);
        const double anchor = found[5] == "middle" ? 0.5 : found[5] == "end" ? 1.0 : 0.0;
        // From above the capital letters to below the small ones.
        boxes.push_back({std::stod(found[1]) - anchor * length, std::stod(found[2]) - 0.76 * size,
                         length, size});
    }
    return boxes;
}

bool meet(const cairo_rectangle_t& a, const cairo_rectangle_t& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height &&
           b.y < a.y + a.height;
}

TEST_F(PlotAreaTest, WritesNoTextOverText) {
    const auto file = directory_.path() / "picture.svg";
    Page page(file, PlotArea::page_height(9));
    PlotArea area(page, {1.0, 1e5, true}, {1e-4, 1e3, true});
    area.title(repeated("12th Gen. ", 20), repeated("12th Gen. ", 30));
    area.grid("rays", "ms");
    for (int i = 0; i < 8; ++i)
        area.legend("depth buffer, C: Quadro NVS 160M, Windows", colours::wall, 1.0, i % 2 == 0);
    area.legend_of_dot("the casts of these scans alone, measured without scipd", colours::wall,
                       4.0);
    ASSERT_EQ(page.finish(), std::nullopt);
    const auto boxes = texts_of(file);
    // Two lines below the title, 6 and 8 numbers, the names of both axes and 9 of the legend.
    ASSERT_EQ(boxes.size(), 3U + 6U + 8U + 2U + 9U);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_GE(boxes[i].x, 0.0) << i;
        EXPECT_LE(boxes[i].x + boxes[i].width, Page::width) << i;
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(meet(boxes[i], boxes[k])) << i << " and " << k;
    }
}

// A margin of 5 % at most, and no line cut away.
TEST_F(PlotAreaTest, EndsBelowWhatIsDrawn) {
    for (const int lines : {0, 1, 3, 6, 9}) {
        const Picture picture = drawn("Title", "machine", lines);
        EXPECT_GE(picture.ink().bottom, 0.95 * picture.height()) << lines;
        EXPECT_LE(picture.ink().bottom, picture.height() - 8) << lines;
    }
}

}  // namespace
}  // namespace scipd::tools
