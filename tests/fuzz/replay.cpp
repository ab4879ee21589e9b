// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Takes the place of libFuzzer if there is none: it runs every file of the given folders once. So
// every find of a fuzzer is a test from then on, with every compiler.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void replay(const std::filesystem::path& file) {
    // Names the file first, so that after a crash the last line names the culprit.
    std::cout << file.string() << std::endl;
    std::ifstream in{file, std::ios::binary};
    // The bytes are on the heap and of exactly this size, so that a sanitizer sees a read past the
    // end.
    const std::vector<char> bytes{std::istreambuf_iterator<char>{in}, {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::filesystem::path> files;
    for (const std::string_view folder :
         std::span{argv, static_cast<std::size_t>(argc)}.subspan(1)) {
        for (const auto& entry : std::filesystem::directory_iterator{folder}) {
            if (entry.is_regular_file()) files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files)
        replay(file);
    std::cout << files.size() << " inputs replayed\n";
    return files.empty() ? 1 : 0;
}
