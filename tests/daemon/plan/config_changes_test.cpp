// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/plan/config_changes.h"

#include <gtest/gtest.h>

#include "daemon/config/config_file.h"
#include "tests/support/temp_dir.h"

namespace scipd::daemon {
namespace {

Config config(const std::string& robots, const std::string& more = {}) {
    const tests::TempDir folder;
    folder.write("room.sdf", "");
    Config read = parse_config("scene: room.sdf\nrobots: {" + robots + "}\n" + more,
                               folder.path() / "lab.yaml");
    read.scene = "room.sdf";
    read.allow.clear();
    return read;
}

const std::string front = "r: {sensors: {front: {model: UST-10LX, pty: auto}}}";

TEST(ConfigChanges, AreNoneBetweenEquals) {
    EXPECT_EQ(changes_between(config(front), config(front)), "nothing changed");
}

TEST(ConfigChanges, NameWhatIsNewGoneAndOther) {
    EXPECT_EQ(
        changes_between(config(front), config("q: {sensors: {a: {model: UST-10LX, pty: auto}, "
                                              "b: {model: UST-10LX, pty: auto}}}")),
        "new: q/a, q/b; gone: r/front");
    EXPECT_EQ(changes_between(config(front),
                              config("r: {pose: {xyz: [1, 0, 0]}, sensors: {front: {model: "
                                     "UST-20LX, pty: auto}}}",
                                     "seed: 7\n")),
              "changed: seed, r, r/front");
}

}  // namespace
}  // namespace scipd::daemon
