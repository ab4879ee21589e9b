// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// MRPT's driver reads the intensity of every model that has it, where the light of the walls is
// simulated. It knows no second echoes.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/models/model_registry.h"
#include "tests/end_to_end/in_square_room.h"
#include "tests/end_to_end/mrpt_driver.h"

namespace scipd::tests {
namespace {

std::vector<std::string> models_with_intensity() {
    std::vector<std::string> names;
    for (const daemon::Model& model : daemon::models()) {
        // Those of the URG have another way to ask for it.
        if (model.profile.family != protocol::Family::urg)
            names.push_back(model.profile.name + "@" + model.profile.release);
    }
    return names;
}

std::string configuration(const std::vector<std::string>& models) {
    std::string text =
        "scene: " + scene("square_room.sdf").string() + "\nrobots:\n  robot:\n    sensors:\n";
    for (const std::string& model : models) {
        text += "      s" + std::to_string(&model - models.data()) + ": {model: " + model +
                ", mount: {xyz: [0, 0, 0.3]}, accuracy: material, timing: ideal, "
                "tcp: 127.0.0.1:0, profile: {noise: []}}\n";
    }
    return text;
}

// The wall ahead is 3 m away and met head-on. Its light is that of the default material: nine
// tenths of white.
TEST(MrptDriverOnLight, ReadsTheIntensityOfEveryModelThatHasIt) {
    const std::vector<std::string> models = models_with_intensity();
    ASSERT_GT(models.size(), 10U);
    const TempDir directory;
    const DaemonProcess daemon(directory,
                               {"--config", directory.write("rig.yaml", configuration(models))});
    ASSERT_NE(daemon.ready_line(), "") << daemon.standard_error();
    for (std::size_t i = 0; i < models.size(); ++i) {
        SCOPED_TRACE(models[i]);
        MrptDriver driver(daemon, Link::tcp, i, true);
        const MrptDriver::Scan scan = driver.next_scan();
        ASSERT_TRUE(scan.hasIntensity());
        const auto front = scan.getScanSize() / 2;
        EXPECT_NEAR(scan.getScanRange(front), 3.0, 0.05);
        const daemon::Model& model = daemon::find_model(models[i]);
        // It varies by a few per cent.
        const double white = model.optics.intensity(3.0, 1.0);
        EXPECT_NEAR(scan.getScanIntensity(front), 0.9 * white, 0.1 * white);
    }
}

}  // namespace
}  // namespace scipd::tests
