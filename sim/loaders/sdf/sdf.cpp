// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf.h"

#include <utility>

#include "sim/loaders/file/doing.h"
#include "sim/loaders/file/load_error.h"
#include "sim/loaders/file/plain_file.h"
#include "sim/loaders/file/scene_draft.h"
#include "sim/loaders/resources/model_folder.h"
#include "sim/loaders/resources/resources.h"
#include "sim/loaders/sdf/sdf_reader.h"
#include "sim/loaders/sdf/sdf_scene.h"

namespace scipd::sim {
namespace {

namespace fs = std::filesystem;

LoadedScene load(const SdfSource& source, const fs::path& folder, const SdfOptions& options) {
    const Resources resources{folder, options.model_folders};
    SceneDraft draft(source.file, options.strict);
    SdfTree tree = SdfReader(resources, options, draft).read(source);
    now_doing("putting together what " + source.file.string() + " shows");
    add_to_scene(std::move(tree), source.file, resources, options, draft);
    const bool visual = options.geometry == SdfGeometry::visual;
    LoadedScene loaded = std::move(draft).finish(visual ? "<visual>" : "<collision>");
    if (options.strict && !loaded.warnings.empty()) throw LoadError(loaded.warnings);
    return loaded;
}

/// Where the first element of a document begins.
std::size_t first_element(std::string_view text) {
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
        if (text.substr(at).starts_with("<!--")) {
            at = text.find("-->", at);
            if (at == text.npos) break;
        } else if (!text.substr(at).starts_with("<?")) {
            return at;
        }
    }
    return text.size();
}

}  // namespace

LoadedScene load_sdf(const fs::path& given, const SdfOptions& options) {
    // Messages name a file in one way only.
    const auto named = fs::absolute(given).lexically_normal();
    std::vector<std::string> of_folder;
    const auto file = model_file_of(named, of_folder);
    for (std::string& warning : of_folder)
        warning = named.string() + ": " + warning;
    if (options.strict && !of_folder.empty()) throw LoadError(std::move(of_folder));
    if (file.empty()) {
        throw LoadError({named.string() +
                         ": is a folder without a model.config that names an SDF file; name a file "
                         "or the folder of a model"});
    }
    if (const auto plain = check_plain_file(file); !plain) {
        throw LoadError(
            {file.string() + ": " + plain.error().why + "; name an SDF world or model"});
    }
    LoadedScene loaded = load({file}, file.parent_path(), options);
    loaded.warnings.insert(loaded.warnings.begin(), of_folder.begin(), of_folder.end());
    return loaded;
}

LoadedScene load_sdf_text(const std::string& text, const std::string& name, const fs::path& folder,
                          const SdfOptions& options) {
    std::string document = text;
    if (const auto at = first_element(text);
        std::string_view{text}.substr(at).starts_with("<model")) {
        document = "<sdf version='1.12' xmlns:scipd='urn:scipd:sdf'>" + text.substr(at) + "</sdf>";
    }
    return load({name, document}, fs::absolute(folder).lexically_normal(), options);
}

}  // namespace scipd::sim
