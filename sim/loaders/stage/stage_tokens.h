// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Splits a world file of Stage into words, numbers, texts and brackets. The tokens of an included
// file stand in place of the include. Any thread; nothing shared.
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
    std::vector<std::string> warnings;  ///< about included files that do not exist

    [[nodiscard]] std::string place_of(const StageToken& token) const {
        return files[token.file].string() + ':' + std::to_string(token.line);
    }
};

/// The path and the text of a file. FindInclude returns those of an included file, by its name and
/// the file that includes it; nothing if it does not exist.
struct StageText {
    std::filesystem::path file;
    std::string text;
};
using FindInclude = std::function<std::optional<StageText>(const std::string& name,
                                                           const std::filesystem::path& by)>;

/// Throws LoadError, naming file and line, if the text is not in Stage's language, if includes go
/// in circles, or if there are too many tokens.
StageTokens stage_tokens(const StageText& world, const FindInclude& find);

}  // namespace scipd::sim
