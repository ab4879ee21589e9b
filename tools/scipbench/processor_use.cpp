// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tools/scipbench/processor_use.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include <unistd.h>

namespace scipd::tools {
namespace {

namespace fs = std::filesystem;

std::string proc_text(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// utime and stime, which are the 14th and 15th word of proc(5); the second one is a name in
/// brackets, which may hold anything.
bool read_times(const fs::path& process, ProcessorUse& use) {
    constexpr int words_between = 11;
    const std::string text = proc_text(process / "stat");
    const std::size_t name_end = text.rfind(')');
    if (name_end == std::string::npos) return false;
    std::istringstream words(text.substr(name_end + 1));
    std::string word;
    for (int i = 0; i < words_between; ++i)
        words >> word;
    const auto ticks_a_second = static_cast<double>(::sysconf(_SC_CLK_TCK));
    double user = 0.0;
    double kernel = 0.0;
    words >> user >> kernel;
    use.user_s = user / ticks_a_second;
    use.kernel_s = kernel / ticks_a_second;
    return static_cast<bool>(words);
}

ThreadUse thread_use(const fs::path& thread) {
    constexpr double ns = 1e-9;
    ThreadUse use{.name = proc_text(thread / "comm")};
    if (!use.name.empty()) use.name.pop_back();
    std::istringstream counts(proc_text(thread / "schedstat"));
    counts >> use.ran_s >> use.waited_s;
    use.ran_s *= ns;
    use.waited_s *= ns;
    return use;
}

}  // namespace

double ProcessorUse::waited_s() const {
    double sum_s = 0.0;
    for (const auto& [id, thread] : threads)
        sum_s += thread.waited_s;
    return sum_s;
}

std::optional<ProcessorUse> processor_use_of(pid_t process) {
    const fs::path directory = fs::path("/proc") / std::to_string(process);
    ProcessorUse use;
    if (!read_times(directory, use)) return std::nullopt;
    std::error_code error;
    for (const auto& thread : fs::directory_iterator(directory / "task", error))
        use.threads[std::stoi(thread.path().filename())] = thread_use(thread.path());
    return use;
}

ProcessorUse use_between(const ProcessorUse& earlier, const ProcessorUse& later, double seconds) {
    ProcessorUse use{.user_s = (later.user_s - earlier.user_s) / seconds,
                     .kernel_s = (later.kernel_s - earlier.kernel_s) / seconds,
                     .threads = later.threads};
    for (auto& [id, thread] : use.threads) {
        const auto before = earlier.threads.find(id);
        if (before != earlier.threads.end()) {
            thread.ran_s -= before->second.ran_s;
            thread.waited_s -= before->second.waited_s;
        }
        thread.ran_s /= seconds;
        thread.waited_s /= seconds;
    }
    return use;
}

ThreadUse busiest_of(const ProcessorUse& use) {
    const auto busiest = std::ranges::max_element(
        use.threads, {}, [](const auto& entry) { return entry.second.ran_s; });
    return busiest == use.threads.end() ? ThreadUse{} : busiest->second;
}

}  // namespace scipd::tools
