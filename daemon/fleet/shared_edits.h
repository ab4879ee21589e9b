// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Changes of the world that all daemons make: what is asked for here is done here and then told to
// the others; what the others have done is done here, too. The broker puts them in order: whatever
// it says last about a model is what all have. Lives on the I/O thread.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "daemon/fleet/mqtt_link.h"
#include "daemon/fleet/topics.h"
#include "daemon/world/scene_edit.h"
#include "sim/world/scene.h"

namespace scipd::daemon {

class SharedEdits {
  public:
    /// What is kept of each model, by its name.
    using Texts = std::map<std::string, std::string>;
    using EditHere = std::function<void(SceneEdit, EditDone)>;

    struct Hooks {
        EditHere edit;
        /// A model is another one now, or gone.
        std::function<void(const std::string& model)> changed;
        /// The model here is not that of the others; empty: it is again.
        std::function<void(const std::string& model, const std::string& why)> differs;
    };

    SharedEdits(MqttLink& link, const Topics& topics, Hooks hooks)
        : link_(link), topics_(topics), hooks_(std::move(hooks)) {}

    /// What brings the base world to where the broker keeps it. A text that makes no sense is left
    /// out: begin() tells of it. Any thread.
    [[nodiscard]] static std::vector<SceneEdit> edits_for(const sim::Scene& base,
                                                          const Texts& kept);
    /// The world is there, and these edits are made in it.
    void begin(const sim::Scene& base, const Texts& kept);
    /// But for those that could not be made, by model.
    void differ(const std::map<std::string, std::string>& why);
    /// What could not be made is tried again: the configuration is another one.
    void try_again();

    /// Asked for here. `done` is called as the scene editor calls it.
    void edit(SceneEdit edit, EditDone done);
    /// Told by the broker.
    void take(const std::string& model, const std::string& text);
    /// All that the broker keeps, after a time without it.
    void take_all(const Texts& kept);
    /// Tells the broker all, since it has forgotten it.
    void say_all();

    [[nodiscard]] const Texts& texts() const { return wanted_; }

  private:
    [[nodiscard]] std::string text_of_edit(const SceneEdit& edit) const;
    void want(const std::string& model, const std::string& text);
    /// What was asked for was not made.
    void put_back(const std::string& model, const std::string& text, const std::string& before);
    void publish(const std::string& model, const std::string& text);
    void settle(const std::string& model, const std::string& text, const EditOutcome& outcome);

    MqttLink& link_;
    const Topics& topics_;
    Hooks hooks_;
    std::set<std::string> base_;  ///< models of the base world
    /// What was asked of the editor last, by model: the world will be so when it has done all.
    Texts wanted_;
    /// What the others have and the world here has not, by model.
    Texts failed_;
};

}  // namespace scipd::daemon
