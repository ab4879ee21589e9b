// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/scene_editor.h"

#include <future>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "daemon/clock/stepped_clock.h"
#include "tests/daemon/wall_world.h"

namespace scipd::daemon {
namespace {

/// A request that whoever lets go of it last is held up by, until the gate opens.
RequestedBackend request_behind(const std::shared_future<void>& gate) {
    RequestedBackend request;
    request.sensor = "robot/scanner";
    request.backend = "reference";  // which looks at nothing that is settled, nor keeps it
    request.settled = {new BackendChoice, [gate](const BackendChoice* choice) {
                           gate.wait();
                           delete choice;
                       }};
    return request;
}

// They are connections, which must not end on another thread than they live on.
TEST(SceneEditor, LeavesNothingOfThoseWhoAreAnsweredToTheLoader) {
    for (const std::string model : {"model 1", "no such model"}) {
        boost::asio::io_context io;
        World world = wall_world();
        SteppedClock clock;
        std::promise<void> opens;
        const std::shared_future<void> gate = opens.get_future().share();
        Worker worker(io.get_executor());
        SceneEditor editor(world, worker, clock, [&] { return std::vector{request_behind(gate)}; });

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

TEST(SceneEditor, ForgetsWhatIsWithdrawnBeforeItHasBegun) {
    boost::asio::io_context io;
    World world = wall_world();
    SteppedClock clock;
    Worker worker(io.get_executor());
    SceneEditor editor(world, worker, clock, [] { return std::vector<RequestedBackend>{}; });
    std::string answered;
    const auto says = [&](const std::string& word) {
        return [&answered, word](const EditOutcome&) { answered += word; };
    };
    std::stop_source first_goes;
    std::stop_source second_goes;
    auto somebody = std::make_shared<int>();
    const std::weak_ptr<int> still_there = somebody;
    editor.edit(RemoveModel{"nobody"}, says("first "), first_goes.get_token());
    editor.edit(
        RemoveModel{"model 1"},
        [&answered, asks = std::move(somebody)](const EditOutcome&) { answered += "second "; },
        second_goes.get_token());
    first_goes.request_stop();  // it has begun
    second_goes.request_stop();
    editor.edit(RemoveModel{"nobody"}, says("third"));
    EXPECT_TRUE(still_there.expired()) << "a connection, which would stay open";
    EXPECT_TRUE(run_until(io, [&] { return answered.ends_with("third"); }));
    EXPECT_EQ(answered, "first third");
    EXPECT_NE(world.model("model 1"), nullptr);
}

}  // namespace
}  // namespace scipd::daemon
