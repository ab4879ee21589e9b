// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Passes a text through libsdformat, which reads includes only from files: scipd gives it files in
// memory. Any thread, while it holds an SdfConsole; one owner.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include <sdf/Root.hh>
#include <sdf/Types.hh>

#include "sim/loaders/file/plain_file.h"

namespace scipd::sim {

/// The URI by which the library asks for the document with this index.
std::string uri_of(std::size_t document);

class SdfLibrary {
  public:
    /// Makes includes of this URI read `text` from now on. Returns the name that the library gives
    /// to that file.
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
