// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A text through libsdformat, and what it includes from memory: the library wants files. Any
// thread, while it holds an SdfConsole; one owner.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include <sdf/Root.hh>
#include <sdf/Types.hh>

#include "sim/loaders/file/plain_file.h"

namespace scipd::sim {

/// Of a document by its place among them, by which the library asks for it.
std::string uri_of(std::size_t document);

class SdfLibrary {
  public:
    /// What an include of this URI brings from now on, and what the library calls it.
    std::filesystem::path write(const std::string& uri, const std::string& text);

    sdf::Errors load(const std::string& text, sdf::Root& root) const;

  private:
    struct Include {
        std::filesystem::path path;
        File file;
    };
    std::map<std::string, Include> includes_;
};

}  // namespace scipd::sim
