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

constexpr std::size_t most_bytes = 4096;

sim::Expected<> check_privacy(const fs::path& file) {
    std::error_code error;
    const auto permissions = fs::status(file, error).permissions();
    if (error) return {};  // nor can it be read
    const auto any_of = [&](fs::perms some) { return (permissions & some) != fs::perms::none; };
    if (any_of(fs::perms::others_read | fs::perms::others_write)) {
        return sim::refuse("others may read or write " +
                           sim::quote(file.native(), sim::whole_path) +
                           "; `chmod o= FILE` forbids it");
    }
    if (any_of(fs::perms::group_write)) {
        return sim::refuse("its group may write " + sim::quote(file.native(), sim::whole_path) +
                           "; `chmod g-w FILE` forbids it");
    }
    return {};
}

sim::Expected<std::string> only_line_of(const fs::path& file) {
    std::string line(most_bytes, '\0');
    std::ifstream stream{file, std::ios::binary};
    if (!stream) return sim::refuse("cannot read " + sim::quote(file.native(), sim::whole_path));
    stream.read(line.data(), std::ssize(line));
    line.resize(static_cast<std::size_t>(stream.gcount()));
    const std::size_t end = std::min(line.find_first_of("\r\n"), line.size());
    if (line.find_first_not_of(" \t\r\n", end) != std::string::npos) {
        return sim::refuse(sim::quote(file.native(), sim::whole_path) +
                           " has more than one line; a file with a secret holds nothing else");
    }
    line.resize(end);
    return line;
}

}  // namespace

sim::Expected<std::string> secret_in(const fs::path& file) {
    return check_privacy(file).and_then([&] { return only_line_of(file); });
}

}  // namespace scipd::daemon
