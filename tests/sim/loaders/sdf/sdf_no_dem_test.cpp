// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a build without GDAL says to an elevation model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/loaders/sdf/sdf_cast.h"
#include "tests/sim/loaders/sdf/sdf_text.h"

namespace scipd::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SdfNoDem : public SdfCast {};

INSTANTIATE_TEST_SUITE_P(Backends, SdfNoDem, ::testing::Values("reference"), name_of_backend);

TEST_P(SdfNoDem, AnElevationModelIsLeftOutWithWhatToDo) {
    folder_.write("a.tif", "II*");
    load(world(
        model_of(visual("a", "<heightmap><uri>a.tif</uri></heightmap>") + visual("v", unit_box))));
    EXPECT_EQ(scene_->objects.size(), 1U);
    EXPECT_THAT(warnings_, ElementsAre(AllOf(HasSubstr((folder_.path() / "a.tif").string()),
                                             HasSubstr("built without GDAL"),
                                             HasSubstr("gdal_translate -of PNG"))));
}

}  // namespace
}  // namespace scipd::sim
