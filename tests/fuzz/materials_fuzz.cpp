// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a library of materials: the result is surfaces that give back no more than falls on
// them, or faults that can be shown.
#include <cstddef>
#include <cstdint>
#include <string>

#include "sim/loaders/materials/materials_file.h"
#include "tests/fuzz/load_faults.h"

namespace {

using namespace scipd::sim;
using scipd::tests::require;
using scipd::tests::require_faults_of;

constexpr const char* file = "materials.yaml";

void check(const Surface& surface) {
    for (const float share :
         {surface.diffuse, surface.specular, surface.retro, surface.transmission})
        require(share >= 0.0F && share <= 1.0F);
    require(surface.diffuse + surface.specular + surface.retro + surface.transmission <= 1.00001F);
    require(surface.gloss >= 1.0F && surface.roughness >= 0.0F && surface.texture >= 0.0F);
}

void check(std::vector<MaterialOptics> materials) {
    MaterialLibrary library;
    for (MaterialOptics& material : materials) {
        const std::string name = material.name;
        require(!name.empty() && material.assumed <= material.numbers);
        library.add(std::move(material));
        for (const int wavelength_nm : {300, 785, 905, 2000}) {
            check(library.surface({name}, wavelength_nm));
            check(library.surface({name, 0.5}, wavelength_nm));
            check(library.surface({name, 900.0, {0.5, 0.5, 0.5}}, wavelength_nm));
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_materials(text, file));
    } catch (const LoadError& error) {
        require_faults_of(file, error);
    }
    return 0;
}
