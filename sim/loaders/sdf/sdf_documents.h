// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The documents that a world consists of. Each file is parsed once, however often it is included.
// One thread; elements of a document live as long as this object.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/resources/resources.h"
#include "sim/loaders/sdf/sdf_geometry.h"
#include "sim/loaders/sdf/sdf_options.h"

namespace scipd::sim {

/// A file, or a text that messages call `file`.
struct SdfSource {
    std::filesystem::path file;
    std::optional<std::string> text = std::nullopt;
};

struct SdfDocument {
    SdfSheet sheet;
    tinyxml2::XMLDocument xml;

    [[nodiscard]] tinyxml2::XMLElement& root() const {
        return *const_cast<tinyxml2::XMLDocument&>(xml).RootElement();
    }
    [[nodiscard]] bool is_robot() const { return root().Name() == std::string_view{"robot"}; }
};

class SdfDocuments {
  public:
    /// What it gets must outlive it.
    SdfDocuments(const Resources& resources, const SdfOptions& options, SceneDraft& draft)
        : resources_(resources), options_(options), draft_(draft) {}

    /// Throws LoadError if it is neither SDF nor URDF.
    const SdfDocument& open(const SdfSource& source);
    /// The document that an include at `place` names. If there is none the draft is told, and the
    /// result is null.
    const SdfDocument* included(const std::string& uri, const SdfSheet& sheet,
                                const std::string& place);
    /// For one include that changes it, at this place. Throws LoadError if the file is gone.
    SdfDocument& copy_of(const SdfDocument& document, const FilePlace& changed_at);

  private:
    const SdfDocument* found(const std::string& uri, const SdfSheet& sheet,
                             const std::string& place);
    const SdfDocument* read(const std::filesystem::path& file, const std::string& place);
    SdfDocument& add(const std::filesystem::path& file, const std::filesystem::path& folder,
                     const std::string& text);
    SdfDocument& open_file(const std::filesystem::path& file);
    void leave_out_missing(const std::string& uri, const std::filesystem::path& folder,
                           const std::string& place);
    [[nodiscard]] std::uintmax_t largest_file_bytes() const;

    const Resources& resources_;
    const SdfOptions& options_;
    SceneDraft& draft_;
    std::vector<std::unique_ptr<SdfDocument>> documents_;
    std::map<std::filesystem::path, const SdfDocument*> known_;  ///< null: it cannot be read
    /// By URI, and by the folder where a relative one starts.
    std::map<std::pair<std::string, std::filesystem::path>, const SdfDocument*> named_;
    std::set<std::string> told_;  ///< missing downloads, by command
};

/// Does with `model`, of a copy, what the <experimental:params> of an include say: they add to it,
/// change it, and take away or replace what is in it. What finds nothing there is skipped, and told
/// to `skipped` with its element.
void apply_params(
    const tinyxml2::XMLElement& params, tinyxml2::XMLElement& model,
    const std::function<void(const tinyxml2::XMLElement& param, const std::string& why)>& skipped);

}  // namespace scipd::sim
