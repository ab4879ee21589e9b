// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Any bytes as a library of materials: the result is surfaces that give back no more than falls on
// them, or faults that can be shown.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sim/loaders/file/load_error.h"
#include "sim/loaders/materials/materials_file.h"

namespace {

using namespace scipd::sim;

void require(bool holds) {
    if (!holds) std::abort();
}

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

void check(const LoadError& error) {
    require(!error.faults().empty());
    for (const auto& fault : error.faults()) {
        require(fault.starts_with("materials.yaml:"));
        for (const char c : fault)
            require(c >= ' ' && c <= '~');
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text{reinterpret_cast<const char*>(data), size};
    try {
        check(parse_materials(text, "materials.yaml"));
    } catch (const LoadError& error) {
        check(error);
    }
    return 0;
}
