// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/file/any_case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::TempDir;

TEST(AnyCase, FindsWhatIsCalledSoOrNearlySo) {
    const TempDir folder;
    const auto file = folder.write("Meshes/Crate.DAE", "");
    EXPECT_EQ(exactly(folder.path(), "Meshes/Crate.DAE"), file);
    EXPECT_EQ(exactly(folder.path(), "meshes/crate.dae"), "");
    EXPECT_EQ(in_any_case(folder.path(), "meshes/crate.dae"), file);
    EXPECT_EQ(in_any_case(folder.path(), "Meshes/Crate.DAE"), file);
    EXPECT_EQ(in_any_case(folder.path(), "meshes/crate.obj"), "");
    EXPECT_TRUE(differs_in_case(file, "meshes/crate.dae"));
    EXPECT_FALSE(differs_in_case(file, "Meshes/Crate.DAE"));
}

TEST(AnyCase, PrefersTheNameAsItStands) {
    const TempDir folder;
    folder.write("CRATE.dae", "");
    const auto exact = folder.write("crate.dae", "");
    EXPECT_EQ(in_any_case(folder.path(), "crate.dae"), exact);
    EXPECT_EQ(in_any_case(folder.path(), "Crate.dae"), folder.path() / "CRATE.dae")
        << "of several, always the same";
}

TEST(AnyCase, WarnsOfAnotherSpelling) {
    const TempDir folder;
    const auto file = folder.write("World.sdf", "");
    std::vector<std::string> warnings;
    EXPECT_EQ(as_it_is_called(file, warnings), file);
    EXPECT_EQ(as_it_is_called(folder.path() / "nothing.sdf", warnings),
              folder.path() / "nothing.sdf");
    EXPECT_THAT(warnings, IsEmpty());
    EXPECT_EQ(as_it_is_called(folder.path() / "world.SDF", warnings), file);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("world.SDF: is called ")));
}

}  // namespace
}  // namespace scipd::sim
