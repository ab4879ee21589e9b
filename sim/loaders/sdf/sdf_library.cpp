// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_library.h"

#include <climits>
#include <cstdio>
#include <utility>

#include <sdf/ParserConfig.hh>

namespace scipd::sim {
namespace {

/// For includes within includes, the library uses only the global configuration.
class GlobalConfig {
  public:
    explicit GlobalConfig(sdf::ParserConfig config)
        : before_(std::exchange(sdf::ParserConfig::GlobalConfig(), std::move(config))) {}
    ~GlobalConfig() { sdf::ParserConfig::GlobalConfig() = std::move(before_); }
    GlobalConfig(const GlobalConfig&) = delete;
    GlobalConfig& operator=(const GlobalConfig&) = delete;

  private:
    sdf::ParserConfig before_;
};

}  // namespace

std::string uri_of(std::size_t document) {
    // The library looks in the working directory first. No file there can have such a long path.
    static const std::string longer_than_any_path(PATH_MAX, '-');
    return "scipd://" + std::to_string(document) + longer_than_any_path;
}

std::filesystem::path SdfLibrary::write(const std::string& uri, const std::string& text) {
    File memory = memory_file();
    std::FILE* file = memory.get();
    std::fwrite(text.data(), 1, text.size(), file);
    std::fflush(file);
    const std::filesystem::path path = "/proc/self/fd/" + std::to_string(fileno(file));
    includes_[uri] = {path, std::move(memory)};
    return path;
}

sdf::Errors SdfLibrary::load(const std::string& text, sdf::Root& root) const {
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::WARN);
    config.SetFindCallback([this](const std::string& uri) {
        const auto known = includes_.find(uri);
        return known == includes_.end() ? std::string{} : known->second.path.string();
    });
    const GlobalConfig global{config};
    root = sdf::Root{};
    return root.LoadSdfString(text, config);
}

}  // namespace scipd::sim
