// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Files that a user has a command write. One thread.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>

namespace scipd::tools {

/// A check of an option: why no file can be written there; empty if one can. It comes before the
/// measuring begins, which takes minutes.
std::string can_be_written(const std::string& file);

/// Why no picture can be that file; empty: one can.
std::string is_picture(const std::string& file);

/// Calls `write` with the file as a stream, unless nobody named one. Throws std::runtime_error.
template <class Write>
void write_to(const std::string& file, const Write& write) {
    if (file.empty()) return;
    std::ofstream out(file);
    write(out);
    if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace scipd::tools
