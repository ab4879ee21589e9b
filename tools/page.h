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

namespace scipd::tools {

class Page {
  public:
    /// In the page's own units. A PNG has 1.6 pixels for each.
    static constexpr double width = 1000.0;
    static constexpr double height = 1060.0;

    explicit Page(std::filesystem::path file, double page_height = height);

    [[nodiscard]] cairo_t* context() { return context_.get(); }
    /// Writes the file. Returns why it failed, if it did. Nothing may be drawn afterwards.
    [[nodiscard]] std::optional<std::string> finish();

  private:
    std::filesystem::path file_;
    bool pixels_;
    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context_;
};

}  // namespace scipd::tools
