// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A page that becomes a .png or an .svg, by the file's ending. One thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <cairo.h>

#include "tools/colours.h"

namespace scipd::tools {

/// How text is set.
struct TextStyle {
    double size;
    Colour colour = colours::ink;
    double anchor = 0.0;  ///< the share of the text to the left of its place: 0, 0.5 or 1
    bool bold = false;
    bool rimmed = false;  ///< with a pale rim, so that it is legible on anything
};

class Page {
  public:
    /// In the page's own units. A PNG has 1.6 pixels for each.
    static constexpr double width = 1000.0;
    static constexpr double height = 1060.0;

    explicit Page(std::filesystem::path file, double page_height = height);
    Page(const Page&) = delete;
    Page& operator=(const Page&) = delete;

    [[nodiscard]] cairo_t* context() { return context_.get(); }
    /// On the baseline `y`. In an .svg it stays text that one can find and copy, above all that is
    /// drawn.
    void write(const std::string& text, double x, double y, const TextStyle& style);
    [[nodiscard]] double length_of(const std::string& text, double size, bool bold = false);
    /// Writes the file. Returns why it failed, if it did. Nothing may be drawn afterwards.
    [[nodiscard]] std::optional<std::string> finish();

  private:
    [[nodiscard]] std::optional<std::string> write_svg();

    std::filesystem::path file_;
    bool pixels_;
    std::string svg_;    ///< what was drawn
    std::string texts_;  ///< what was written, as elements of an SVG
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace scipd::tools
