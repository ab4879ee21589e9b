// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// What a process can still do that has given up all else, tried in a child.
#include "sim/loaders/reader/no_network.h"

#include <cerrno>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/loaders/file/confined.h"
#include "sim/loaders/file/landlock.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

/// A y for each deed that works then, and an n for each that fails.
std::string after(const std::function<bool()>& giving_up,
                  const std::vector<std::function<bool()>>& deeds) {
    const Confines confines{.processor_time = std::chrono::seconds{20},
                            .memory_bytes = std::size_t{1} << 30};
    const File said = run_confined(confines, [&](std::FILE* out) {
        if (!giving_up()) return;
        for (const auto& deed : deeds)
            std::fputc(deed() ? 'y' : 'n', out);
    });
    return rest_of(said.get());
}

bool makes_a_socket() {
    return socket(AF_INET, SOCK_STREAM, 0) >= 0;
}

bool looks_into_its_parent() {
    return ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr) == 0 || errno != EACCES;
}

bool runs_a_program() {
    const pid_t pid = fork();
    if (pid == 0) {
        execl("/bin/true", "true", nullptr);
        _exit(1);
    }
    int status = -1;
    waitpid(pid, &status, 0);
    return status == 0;
}

TEST(NoNetwork, LeavesWhatAReaderNeeds) {
    const auto all = [] { return true; };
    EXPECT_EQ(after(all, {makes_a_socket, runs_a_program}), "yy");
    const auto nothing = [] { return forbid_network(Programs::none); };
    const std::string left =
        after(nothing, {makes_a_socket, looks_into_its_parent, runs_a_program});
    if (left.empty()) GTEST_SKIP() << "this kernel has no seccomp";
    EXPECT_EQ(left, "nnn");
    const auto programs = [] { return forbid_network(Programs::may_run); };
    EXPECT_EQ(after(programs, {makes_a_socket, looks_into_its_parent, runs_a_program}), "nny");
}

TEST(Landlock, HoldsToFoldersAndToReading) {
    const tests::TempDir inside;
    const tests::TempDir outside;
    const auto may_open = [](const std::string& file, int how) {
        return [=] { return open(file.c_str(), how, 0600) >= 0; };
    };
    const std::string in = inside.write("a", "b");
    const std::string out = outside.write("a", "b");
    const auto held = [&] { return hold_program_to({inside.path()}); };
    const std::string left =
        after(held, {may_open(in, O_RDONLY), may_open(out, O_RDONLY), may_open(in, O_WRONLY),
                     may_open(in + "new", O_WRONLY | O_CREAT), may_open("/dev/null", O_WRONLY)});
    if (left.empty()) GTEST_SKIP() << "this kernel has no Landlock";
    EXPECT_EQ(left, "ynnny");
    const std::string beside = inside.write("b", "c");
    EXPECT_EQ(after([&] { return hold_program_to({in}); },
                    {may_open(in, O_RDONLY), may_open(beside, O_RDONLY)}),
              "yn");
    // As for what a configuration names.
    EXPECT_EQ(after([] { return hold_program_to({"/"}); },
                    {may_open(in, O_RDONLY), may_open(out, O_RDONLY), may_open(out, O_WRONLY)}),
              "yyn");
}

}  // namespace
}  // namespace scipd::sim
