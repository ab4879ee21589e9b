// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A world file of Stage as words, numbers, texts and brackets, with those of the files that it
// includes in their places. Not what they mean. Any thread; nothing shared.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scipd::sim {

struct StageToken {
    enum class Kind { word, number, text, open, close, open_list, close_list };
    Kind kind = Kind::word;
    std::string text;
    std::size_t file = 0;  ///< index into StageTokens::files
    int line = 0;
};

struct StageTokens {
    std::vector<StageToken> all;
    std::vector<std::filesystem::path> files;
    std::vector<std::string> warnings;  ///< of includes that are not there

    [[nodiscard]] std::string place_of(const StageToken& token) const {
        return files[token.file].string() + ':' + std::to_string(token.line);
    }
};

/// The path and the text of an included file, by its name and the file that includes it; nothing
/// where it is not there.
struct StageText {
    std::filesystem::path file;
    std::string text;
};
using FindInclude = std::function<std::optional<StageText>(const std::string& name,
                                                           const std::filesystem::path& by)>;

/// Throws LoadError, naming file and line, where this is no language of Stage's, where includes go
/// in circles, or where it is all too much.
StageTokens stage_tokens(const StageText& world, const FindInclude& find);

}  // namespace scipd::sim
