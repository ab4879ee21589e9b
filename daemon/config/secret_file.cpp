// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/config/secret_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "sim/text/quote.h"

namespace scipd::daemon {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 1025;

sim::Expected<> check_privacy(const fs::path& file) {
    std::error_code error;
    const auto permissions = fs::status(file, error).permissions();
    const auto of_others = permissions & (fs::perms::others_read | fs::perms::others_write);
    if (error || of_others == fs::perms::none) return {};
    return sim::refuse("others may read or write " + sim::quote(file.native()) +
                       "; `chmod o= FILE` forbids it");
}

sim::Expected<std::string> first_line_of(const fs::path& file) {
    std::string line(most_bytes, '\0');
    std::ifstream stream{file, std::ios::binary};
    if (!stream) return sim::refuse("cannot read " + sim::quote(file.native()));
    stream.read(line.data(), std::ssize(line));
    line.resize(static_cast<std::size_t>(stream.gcount()));
    line.resize(std::min(line.find_first_of("\r\n"), line.size()));
    return line;
}

}  // namespace

sim::Expected<std::string> secret_in(const fs::path& file) {
    return check_privacy(file).and_then([&] { return first_line_of(file); });
}

}  // namespace scipd::daemon
