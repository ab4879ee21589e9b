// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any text as an SDF world, a model or a robot that may include a model: the result is a scene in
// which everything lies within reach, or sentences that can be shown.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/sdf/sdf.h"
#include "sim/world/reach.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

/// Messages may hold letters of any language, but nothing that moves a cursor.
void check_sentence(const std::string& sentence) {
    require(!sentence.empty());
    for (const char c : sentence)
        require(c == '\n' || c == '\t' || (static_cast<unsigned char>(c) >= ' ' && c != '\x7f'));
}

void check(const Scene& scene) {
    for (const Model& model : scene.models)
        require(plausible_position(model.world_from_model.translation_m));
    for (const Object& object : scene.objects) {
        require(object.model < scene.models.size() && object.material < scene.materials.size());
        require(std::isfinite(glm::length(object.model_from_object.rotation)));
    }
    for (const Frame& frame : scene.frames)
        require(frame.model < scene.models.size());
}

/// A folder with one model, `part`.
const std::filesystem::path& folder() {
    static const std::filesystem::path made = [] {
        std::string name = std::filesystem::temp_directory_path() / "scipd-sdf-fuzz-XXXXXX";
        require(mkdtemp(name.data()) != nullptr);
        std::ofstream{std::filesystem::path{name} / "part"}
            << "<sdf version='1.11'><model name='m' placement_frame='f'><frame name='f'/><link "
               "name='l'><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry>"
               "</visual></link><model name='n'><link name='k'/></model></model></sdf>";
        return std::filesystem::path{name};
    }();
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        const LoadedScene loaded = load_sdf_text(
            text, "a", folder(),
            {.most_memory_bytes = std::size_t{100} << 20U, .most_triangles = 100'000});
        check(*loaded.scene);
        for (const std::string& warning : loaded.warnings)
            check_sentence(warning);
    } catch (const LoadError& error) {
        for (const std::string& fault : error.faults())
            check_sentence(fault);
    }
    return 0;
}
