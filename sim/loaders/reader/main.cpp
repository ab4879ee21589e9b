// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// scipd-read reads worlds and models for scipd, which starts it for each (reader_program.h). Nobody
// else calls it: its standard input is a request, its standard output the answer, and descriptor 3
// what it is doing. It has one thread.
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "sim/loaders/file/between_processes.h"
#include "sim/loaders/file/child_work.h"
#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/landlock.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/reader/no_network.h"
#include "sim/loaders/reader/read_scene.h"
#include "sim/loaders/reader/scene_answer.h"
#include "sim/loaders/terrain/gdal_dem.h"

namespace {

using namespace scipd::sim;

void put_texts(const std::vector<std::string>& texts, std::FILE* out) {
    put_each(texts, out, put_all<std::string>);
}

/// Without a kernel that can do so, the reader itself still looks where each file lies.
void give_up_all_else(const SceneRequest& request) {
    if (request.folders) read_only_from(*request.folders);
    Folders readable = request.folders.value_or(Folders{"/"});
    readable.push_back(dem_module());
    (void)hold_program_to(readable);
    (void)forbid_network(request.runs_xacro() ? Programs::may_run : Programs::none);
}

void answer(const SceneRequest& request, std::FILE* out) {
    try {
        give_up_all_else(request);
        const LoadedScene loaded = read_scene(request);
        put(true, out);
        put_texts(loaded.warnings, out);
        put_scene(*loaded.scene, out);
    } catch (const LoadError& error) {
        put(false, out);
        put_texts(error.faults(), out);
    }
}

/// Libraries may print to standard output, which then is standard error.
File answer_file() {
    File file{fdopen(dup(STDOUT_FILENO), "r+")};
    dup2(STDERR_FILENO, STDOUT_FILENO);
    return file;
}

}  // namespace

int main() {
    if (isatty(STDIN_FILENO) != 0) {
        std::fputs("scipd-read: scipd starts this program to have it read a world; you need not\n",
                   stderr);
        return 2;
    }
    SceneRequest request;
    try {
        request = take_request(stdin);
    } catch (const std::exception& error) {
        std::fputs(error.what(), stdout);
        return failed_with_words;
    }
    begin_doing(doing_descriptor);
    const File out = answer_file();
    const Confines confines{.processor_time = request.processor_time,
                            .memory_bytes = request.memory_bytes};
    work_as_child(
        confines, request.asked_by, [&](std::FILE* to) { answer(request, to); }, out.get());
}
