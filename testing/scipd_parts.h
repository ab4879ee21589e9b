// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a Scipd hands out to be steered: robots, the world, time, faults, the conversation. Each is
// a handle that must not outlive its Scipd. One thread. All throw ScipdError.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "testing/scipd_values.h"

namespace scipd::testing {

struct ScipdInside;

class Robot {
  public:
    Robot(ScipdInside& inside, std::string name) : inside_(inside), name_(std::move(name)) {}

    [[nodiscard]] Pose pose() const;
    /// The robot is there at once.
    void set_pose(const Pose& pose) const;
    /// Has it move there evenly, and returns when it is there. In lockstep time goes on so far.
    void drive_to(const Pose& pose, std::chrono::duration<double> seconds) const;
    /// Has it move along a TUM file, `speed` times as fast, and returns when it is at its end. In
    /// lockstep time goes on so far.
    void play(const std::filesystem::path& trajectory, double speed = 1.0) const;

  private:
    ScipdInside& inside_;
    std::string name_;
};

/// It stands on its pose.
struct Box {
    std::array<double, 3> size_m;
    std::string material = {};
};

/// OBJ, STL, PLY, COLLADA or glTF.
struct Mesh {
    std::filesystem::path file;
    std::string material = {};  ///< empty: as the file has it
    double scale = 1;
};

/// The text of a <model>.
struct Sdf {
    std::string text;
};

/// A file or folder that is a model.
struct ModelFile {
    std::filesystem::path file;
};

class Scene {
  public:
    using What = std::variant<Box, Mesh, Sdf, ModelFile>;

    explicit Scene(ScipdInside& inside) : inside_(inside) {}

    /// The next scan of each scanner sees it. Returns the warnings of scipd.
    std::vector<std::string> add(const std::string& name, const What& what,
                                 const Pose& pose = {}) const;
    void move(const std::string& name, const Pose& pose) const;
    void remove(const std::string& name) const;
    /// Another world in the place of this one. Returns the warnings of scipd.
    std::vector<std::string> load(const std::filesystem::path& world) const;
    [[nodiscard]] Pose pose(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> models() const;

  private:
    ScipdInside& inside_;
};

class Clock {
  public:
    explicit Clock(ScipdInside& inside) : inside_(inside) {}

    /// In lockstep has time go on so far; else waits. Throws TimeStandsStill.
    void run(std::chrono::duration<double> seconds) const;
    /// Since the start of scipd, or in lockstep the stamp.
    [[nodiscard]] double time_s() const;

  private:
    ScipdInside& inside_;
};

/// What goes wrong on purpose. It ends with stop(), or as it was asked for, not with this object.
class Fault {
  public:
    Fault(ScipdInside& inside, std::string path, int id)
        : inside_(inside), path_(std::move(path)), id_(id) {}

    void stop() const;
    /// waiting, active or ended.
    [[nodiscard]] std::string state() const;
    /// How often it has acted.
    [[nodiscard]] int hits() const;

  private:
    [[nodiscard]] Json status() const;

    ScipdInside& inside_;
    std::string path_;  ///< of all faults of this sensor
    int id_;
};

struct WireMessage {
    std::string sensor;
    std::string client;  ///< tcp or tty
    double time_s = 0;
    bool from_client = false;
    std::string line;    ///< the request, or the echo of a reply
    std::string status;  ///< of a reply
    std::string means;
};

class Wire {
  public:
    explicit Wire(ScipdInside& inside) : inside_(inside) {}

    /// What was said so far, by all scanners and their clients.
    [[nodiscard]] std::vector<WireMessage> messages() const;
    /// A message a line.
    [[nodiscard]] std::string text() const;
    /// The first request that begins so, such as MD: that of a driver that starts.
    WireMessage wait_for(const std::string& request,
                         std::chrono::milliseconds timeout = std::chrono::seconds(10)) const;

  private:
    ScipdInside& inside_;
};

}  // namespace scipd::testing
