// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/reader/reader_program.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <spawn.h>
#include <unistd.h>

#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/child_process.h"
#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/reader/scene_answer.h"
#include "sim/takes_long.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

/// The packages of Debian are built for another place than they are installed at.
constexpr auto of_package = "/usr/libexec/scipd/scipd-read";

constexpr std::array<std::string_view, 17> passed_on{
    "PATH", "HOME", "LANG", "LC_ALL", "LC_CTYPE", "LD_LIBRARY_PATH", "PYTHONPATH", "PYTHONHOME",
    // resources.h
    "SDF_PATH", "GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GZ_FUEL_CACHE_PATH",
    "VIRTUAL_ENV"};

void check(int error, const char* what) {
    if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

/// How a child is started: with these descriptors alone, and with signals as a shell has them.
class Start {
  public:
    Start(int request, const ChildProcess::Shared& shared) {
        check(posix_spawn_file_actions_init(&files_), "posix_spawn_file_actions_init");
        check(posix_spawnattr_init(&attributes_), "posix_spawnattr_init");
        give(request, STDIN_FILENO);
        give(fileno(shared.answer.get()), STDOUT_FILENO);
        give(shared.doing.descriptor(), doing_descriptor);
        posix_spawn_file_actions_addclosefrom_np(&files_, doing_descriptor + 1);
        sigset_t signals;
        sigemptyset(&signals);
        posix_spawnattr_setsigmask(&attributes_, &signals);
        sigfillset(&signals);
        posix_spawnattr_setsigdefault(&attributes_, &signals);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~Start() {
        posix_spawn_file_actions_destroy(&files_);
        posix_spawnattr_destroy(&attributes_);
    }
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;

    [[nodiscard]] pid_t operator()(const fs::path& program, std::vector<char*> environment) const {
        std::string name = program.filename();
        std::array<char*, 2> words{name.data(), nullptr};
        environment.push_back(nullptr);
        pid_t pid = 0;
        const int error = posix_spawn(&pid, program.c_str(), &files_, &attributes_, words.data(),
                                      environment.data());
        if (error == 0) return pid;
        throw std::runtime_error(program.string() +
                                 " cannot be started: " + std::generic_category().message(error));
    }

  private:
    void give(int descriptor, int as) {
        check(posix_spawn_file_actions_adddup2(&files_, descriptor, as), "adddup2");
    }

    posix_spawn_file_actions_t files_{};
    posix_spawnattr_t attributes_{};
};

/// Where programs and models are, and which language is spoken. Only the xacro of a file that the
/// owner of this process has named sees everything, since such a file may ask for any variable.
bool passes_on(const char* variable, const SceneRequest& request) {
    if (!request.folders && request.runs_xacro()) return true;
    const std::string_view text{variable};
    const auto name = text.substr(0, text.find('='));
    // The last are those of sanitizers.
    return std::ranges::find(passed_on, name) != passed_on.end() || name.ends_with("SAN_OPTIONS");
}

std::vector<char*> environment_for(const SceneRequest& request) {
    std::vector<char*> passed;
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable) {
        if (passes_on(*variable, request)) passed.push_back(*variable);
    }
    return passed;
}

File written(const SceneRequest& request) {
    File file = memory_file();
    put_request(request, file.get());
    if (std::fflush(file.get()) != 0) throw std::bad_alloc();
    std::rewind(file.get());
    return file;
}

Texts take_texts(std::FILE* in) {
    return take_each<Texts>(in, take_all<std::string>);
}

File answer_of(const fs::path& program, const SceneRequest& request, const LoadLimits& limits) {
    const File asked = written(request);
    auto shared = std::make_unique<ChildProcess::Shared>();
    const Start start{fileno(asked.get()), *shared};
    const pid_t pid = start(program, environment_for(request));
    const Confines confines{
        .processor_time = request.processor_time,
        .memory_bytes = request.memory_bytes,
        .wall_time = limits.wall_time,
        .stop = limits.stop,
        .more_memory = {},
        .more_time = "world_load_s under limits in the configuration allows more"};
    return ChildProcess{confines, std::move(shared), pid}.outcome();
}

}  // namespace

fs::path reader_program() {
    if (const char* said = std::getenv("SCIPD_READ")) return said;
    std::error_code error;
    const auto here = fs::read_symlink("/proc/self/exe", error).parent_path();
    const std::array places{(here / SCIPD_READ_FROM_BIN).lexically_normal(),
                            fs::path{SCIPD_READ_INSTALLED}, fs::path{of_package}};
    std::string sought;
    for (const auto& place : places) {
        if (access(place.c_str(), X_OK) == 0) return place;
        sought += (sought.empty() ? "not at " : ", not at ") + place.string();
    }
    throw LoadError({"scipd-read, the program that reads worlds, is " + sought +
                     "; it comes with scipd, and SCIPD_READ can name another place"});
}

LoadedScene read_by(const fs::path& program, SceneRequest request, const LoadLimits& limits) {
    takes_long();
    request.folders = limits.folders;
    request.memory_bytes = limits.memory_bytes;
    // Longer than one thread can use within wall_time: so the wall time ends the child first, and
    // the message is about that.
    request.processor_time = limits.wall_time + std::chrono::seconds{10};
    request.asked_by = getpid();
    try {
        const File answer = answer_of(program, request, limits);
        const bool is_loaded = take_bool(answer.get());
        Texts texts = take_texts(answer.get());
        if (!is_loaded && texts.empty()) refuse_data();
        if (!is_loaded) throw LoadError(std::move(texts));
        return {std::make_shared<const Scene>(take_scene(answer.get())), std::move(texts)};
    } catch (const LoadError&) {
        throw;
    } catch (const std::runtime_error& wrong) {
        throw LoadError({request.name() + ": " + wrong.what()});
    }
}

}  // namespace scipd::sim
