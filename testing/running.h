// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A scipd that runs, as all parts of a Scipd share it: what it said when it was ready, and its
// control API. One thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "testing/kept_process.h"
#include "testing/scipd_options.h"
#include "tools/control_client.h"

namespace scipd::testing {

class Running {
  public:
    /// Returns when it is ready. Throws ScipdNotFound and ScipdNotReady.
    explicit Running(const Options& options);

    [[nodiscard]] const Json& ready() const { return ready_; }
    [[nodiscard]] std::string control() const { return ready_.at("control"); }
    /// In the order of the configuration.
    [[nodiscard]] std::vector<std::string> robots() const;
    /// What the ready line says of a sensor: by ROBOT/SENSOR, by SENSOR where that says enough,
    /// without a name the only scanner, or the first one. Throws std::invalid_argument.
    [[nodiscard]] const Json& sensor(const std::string& name) const;

    /// The answer; null if it is empty, a string if it is no JSON. Throws Refused and ScipdEnded.
    [[nodiscard]] Json ask(const std::string& method, const std::string& path,
                           const Json& body = nullptr);
    [[nodiscard]] Json get(const std::string& path);
    /// A change that takes effect at once, such as a pose.
    void put(const std::string& path, const Json& body);

    [[nodiscard]] int pid() const { return process_.pid(); }
    [[nodiscard]] std::string log() const { return process_.log(); }
    [[nodiscard]] std::string log_end() const;
    /// Nothing: it runs. A negative code is that of the signal that ended it.
    [[nodiscard]] std::optional<int> exit_code();
    /// Ends it. Throws ScipdEnded if it had ended by itself or has failed to end well, and nobody
    /// was told so far.
    void close();
    /// Nobody answers on the control socket.
    [[noreturn]] void tell_why_gone();

  private:
    template <class Question>
    auto answer_to(Question question);
    [[nodiscard]] ScipdEnded gone(int code);

    KeptProcess process_;
    Json ready_;
    std::optional<tools::ControlClient> client_;
    bool closed_ = false;
    bool told_ = false;  ///< somebody knows that it has ended by itself
};

/// The path of a sensor in the control API.
[[nodiscard]] std::string sensor_path(const std::string& name);

}  // namespace scipd::testing
