// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/control/scene_editor.h"

#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

/// A wish that whoever lets go of it last is held up by, until the gate opens.
BackendWish wish_behind(const std::shared_future<void>& gate) {
    BackendWish wish;
    wish.sensor = "robot/scanner";
    wish.backend = "reference";  // which looks at nothing that is settled, nor keeps it
    wish.settled = {new BackendChoice, [gate](const BackendChoice* choice) {
                        gate.wait();
                        delete choice;
                    }};
    return wish;
}

// They are connections, which must not end on another thread than they live on.
TEST(SceneEditor, LeavesNothingOfThoseWhoAreAnsweredToTheLoader) {
    for (const std::string model : {"model 1", "no such model"}) {
        boost::asio::io_context io;
        World world = wall_world();
        std::promise<void> opens;
        const std::shared_future<void> gate = opens.get_future().share();
        Loader loader(io.get_executor());
        SceneEditor editor(world, loader, [&] { return std::vector{wish_behind(gate)}; });

        auto somebody = std::make_shared<int>();
        const std::weak_ptr<int> still_there = somebody;
        bool answered = false;
        editor.edit(RemoveModel{model}, [&answered, asks = std::move(somebody)](
                                            const EditOutcome&) { answered = true; });
        EXPECT_TRUE(run_until(io, [&] { return answered; }));
        EXPECT_TRUE(still_there.expired()) << model;
        opens.set_value();
    }
}

}  // namespace
}  // namespace scipd::daemon
