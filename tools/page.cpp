// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/page.h"

#include <utility>

#include <cairo-svg.h>

namespace scipd::tools {
namespace {

constexpr double pixels_per_unit = 1.6;

cairo_surface_t* make_surface(const std::filesystem::path& file, bool pixels, double height) {
    if (!pixels) return cairo_svg_surface_create(file.c_str(), Page::width, height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                      static_cast<int>(Page::width * pixels_per_unit),
                                      static_cast<int>(height * pixels_per_unit));
}

}  // namespace

Page::Page(std::filesystem::path file, double page_height)
    : file_(std::move(file)),
      pixels_(file_.extension() == ".png"),
      surface_(make_surface(file_, pixels_, page_height), cairo_surface_destroy),
      context_(cairo_create(surface_.get()), cairo_destroy) {
    if (pixels_) cairo_scale(context(), pixels_per_unit, pixels_per_unit);
}

std::optional<std::string> Page::finish() {
    cairo_status_t status = cairo_status(context());
    if (status == CAIRO_STATUS_SUCCESS && pixels_) {
        status = cairo_surface_write_to_png(surface_.get(), file_.c_str());
    }
    cairo_surface_finish(surface_.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
    if (status == CAIRO_STATUS_SUCCESS) return std::nullopt;
    return cairo_status_to_string(status);
}

}  // namespace scipd::tools
