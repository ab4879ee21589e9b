// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "daemon/world/scene_editor.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <spdlog/spdlog.h>

#include "daemon/world/backend_maker.h"
#include "daemon/world/edited_scene.h"
#include "sim/loaders/file/load_error.h"

namespace scipd::daemon {

/// The new scene, ready to be cast into.
struct SceneEditor::Next {
    std::filesystem::path file;
    sim::SharedScene scene;
    SensorBackends backends;
    std::set<std::string> placed_anew;  ///< models that are where the scene has them
    std::vector<std::string> warnings;
    std::vector<std::string> notes;
    AddedTriangles added;
    bool whole;  ///< another world, not a change of this one
};

using Result = EditOutcome::Result;

void SceneEditor::edit(SceneEdit edit, EditDone done, std::stop_token withdrawn) {
    auto begin = [this, edit = std::move(edit), done = std::move(done),
                  withdrawn]() -> Worker::Work {
        PresentScene present{file_, world_.scene(), options_, allow_, added_, limits_->values()};
        return [this, edit, done, present = std::move(present), requests = requests_(),
                stopping = worker_.stopping(), withdrawn]() mutable -> Worker::Finish {
            std::stop_source nobody_waits;
            const auto stop = [&] { nobody_waits.request_stop(); };
            const std::stop_callback when_stopping{stopping, stop};
            const std::stop_callback when_withdrawn{withdrawn, stop};
            present.options.limits.stop = nobody_waits.get_token();
            // `done` belongs to the I/O thread and is moved back there. If a copy stayed here, the
            // worker's thread might be the one that destroys it.
            const auto refused = [&](EditOutcome why) {
                return [this, done = std::move(done), outcome = std::move(why)] {
                    if (outcome.result == Result::too_much)
                        limits_->refuse(outcome.limit, "scene edit");
                    done(outcome);
                };
            };
            try {
                EditedOrNot now = edited(edit, present);
                if (!now) return refused(std::move(now.error()));
                for (const std::string& note : now->notes)
                    spdlog::info("{}", note);
                const auto next = std::make_shared<Next>();
                *next = {now->file,
                         now->scene,
                         make_backends(requests, now->scene),
                         {},
                         std::move(now->warnings),
                         std::move(now->notes),
                         std::move(now->all_added),
                         std::holds_alternative<LoadWorld>(edit)};
                for (const sim::Model& model : now->added->models)
                    next->placed_anew.insert(model.name);
                return [this, next, done = std::move(done)] {
                    take_up(*next);
                    warn_of_lost_bodies(*next);
                    if (next->whole) warnings_.clear();
                    std::ranges::copy(next->warnings, std::back_inserter(warnings_));
                    done({Result::done, next->warnings, next->notes});
                };
            } catch (const sim::LoadError& error) {
                return refused({Result::faulty, error.faults()});
            } catch (const std::exception& error) {
                return refused({Result::faulty, {error.what()}});
            }
        };
    };
    worker_.add(std::move(begin), std::move(withdrawn));
}

void SceneEditor::add_warnings(const std::vector<std::string>& warnings) {
    std::ranges::copy_if(warnings, std::back_inserter(warnings_), [&](const std::string& warning) {
        return std::ranges::find(warnings_, warning) == warnings_.end();
    });
}

void SceneEditor::take_up(Next& next) {
    loads_ += next.whole ? 1 : 0;
    file_ = next.file;
    added_ = std::move(next.added);
    worker_.discard(std::make_shared<SensorBackends>(world_.replace_scene(
        std::move(next.scene), std::move(next.backends), next.placed_anew, clock_.now())));
}

void SceneEditor::warn_of_lost_bodies(Next& next) const {
    for (const auto& [robot, body] : world_.lost_bodies()) {
        next.warnings.push_back(file_.string() + ": has no movable model \"" + body +
                                "\" to be the body of robot \"" + robot + "\"");
    }
}

}  // namespace scipd::daemon
