// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/page.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include <cairo-svg.h>

#include "tools/markup.h"

namespace scipd::tools {
namespace {

constexpr double pixels_per_unit = 1.6;
constexpr double rim = 4.0;
constexpr Colour of_rim{1.0, 1.0, 1.0, 0.9};

cairo_status_t append(void* svg, const unsigned char* bytes, unsigned int count) {
    static_cast<std::string*>(svg)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(std::string& svg, bool pixels, double height) {
    if (!pixels) return cairo_svg_surface_create_for_stream(append, &svg, Page::width, height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                      static_cast<int>(Page::width * pixels_per_unit),
                                      static_cast<int>(height * pixels_per_unit));
}

void use(cairo_t* context, const Colour& colour) {
    cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.opacity);
}

std::string hex(const Colour& colour) {
    const auto level = [](double part) { return static_cast<int>(std::lround(255.0 * part)); };
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", level(colour.red), level(colour.green),
                  level(colour.blue));
    return text.data();
}

std::string element_of(const std::string& text, double x, double y, const TextStyle& style) {
    std::ostringstream out;
    out << "<text xml:space=\"preserve\" x=\"" << x << "\" y=\"" << y
        << R"(" font-family="sans-serif" font-size=")" << style.size << "\" fill=\""
        << hex(style.colour) << '"';
    if (style.anchor > 0.0)
        out << " text-anchor=\"" << (style.anchor < 1.0 ? "middle" : "end") << '"';
    if (style.bold) out << R"( font-weight="bold")";
    if (style.rimmed) {
        out << " stroke=\"" << hex(of_rim) << "\" stroke-opacity=\"" << of_rim.opacity
            << "\" stroke-width=\"" << rim << R"(" stroke-linejoin="round" paint-order="stroke")";
    }
    out << '>' << in_markup(text) << "</text>\n";
    return out.str();
}

void draw(cairo_t* context, const std::string& text, const TextStyle& style) {
    if (style.rimmed) {
        cairo_text_path(context, text.c_str());
        cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
        use(context, of_rim);
        cairo_set_line_width(context, rim);
        cairo_stroke_preserve(context);
        use(context, style.colour);
        cairo_fill(context);
        return;
    }
    use(context, style.colour);
    cairo_show_text(context, text.c_str());
    cairo_new_path(context);  // showing text leaves a point behind
}

}  // namespace

Page::Page(std::filesystem::path file, double page_height)
    : file_(std::move(file)),
      pixels_(file_.extension() == ".png"),
      surface_(make_surface(svg_, pixels_, page_height), cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
    if (pixels_) cairo_scale(context(), pixels_per_unit, pixels_per_unit);
}

double Page::length_of(const std::string& text, double size, bool bold) {
    cairo_select_font_face(context(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(context(), text.c_str(), &extents);
    return extents.x_advance;
}

void Page::write(const std::string& text, double x, double y, const TextStyle& style) {
    // It also finds out what is no UTF-8, which no file may have.
    const double length = length_of(text, style.size, style.bold);
    if (!pixels_) {
        texts_ += element_of(text, x, y, style);
        return;
    }
    cairo_move_to(context(), x - style.anchor * length, y);
    draw(context(), text, style);
}

std::optional<std::string> Page::finish() {
    cairo_status_t status = cairo_status(context());
    if (status == CAIRO_STATUS_SUCCESS && pixels_) {
        status = cairo_surface_write_to_png(surface_.get(), file_.c_str());
    }
    cairo_surface_finish(surface_.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
    if (status != CAIRO_STATUS_SUCCESS) return cairo_status_to_string(status);
    return pixels_ ? std::nullopt : write_svg();
}

std::optional<std::string> Page::write_svg() {
    svg_.insert(svg_.rfind("</svg>"), texts_);
    errno = 0;
    std::ofstream out(file_, std::ios::binary);
    out << svg_;
    if (out.flush()) return std::nullopt;
    return std::generic_category().message(errno);
}

}  // namespace scipd::tools
