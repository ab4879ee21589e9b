// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a folder reaches through the headers of others: a law on its own includes alone would not
// see that.
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path root = SCIPD_SOURCES;

/// Adds the headers of the project that this file includes, and those that they include.
void add_reached(const fs::path& file, std::set<std::string>& reached) {
    std::ifstream stream(root / file);
    for (std::string line; std::getline(stream, line);) {
        constexpr std::string_view keyword = "#include \"";
        if (!line.starts_with(keyword)) continue;
        const std::string included = line.substr(keyword.size(), line.rfind('"') - keyword.size());
        if (reached.insert(included).second) add_reached(included, reached);
    }
}

std::set<std::string> reached_from(const fs::path& folder) {
    std::set<std::string> reached;
    for (const auto& entry : fs::directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension == ".h" || extension == ".cpp")
            add_reached(fs::relative(entry.path(), root), reached);
    }
    return reached;
}

TEST(Reach, OfALinkEndsBeforeWorldsAndBackends) {
    const std::set<std::string> reached = reached_from("daemon/link");
    EXPECT_TRUE(reached.contains("protocol/session.h"));
    for (const std::string& header : reached) {
        for (const std::string_view folder :
             {"daemon/world/", "daemon/device/", "sim/backends/", "sim/world/", "sim/sensor/"})
            EXPECT_FALSE(header.starts_with(folder)) << header;
    }
}

TEST(Reach, GoesThroughHeaders) {
    EXPECT_TRUE(reached_from("daemon/device").contains("sim/world/scene.h"));
}

}  // namespace
