// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// SDF in a few words, for tests.
#pragma once

#include <string>

namespace scipd::sim {

inline std::string sdf(const std::string& inside) {
    return "<?xml version=\"1.0\"?>\n<sdf version=\"1.9\" xmlns:scipd=\"urn:scipd:sdf\">\n" +
           inside + "\n</sdf>\n";
}

inline std::string world(const std::string& inside) {
    return sdf("<world name=\"w\">\n" + inside + "\n</world>");
}

/// A static model of one link with these visuals.
inline std::string model_of(const std::string& visuals) {
    return "<model name=\"m\"><static>true</static><link name=\"l\">\n" + visuals +
           "\n</link></model>";
}

/// A visual of one geometry; `more` stands before it: a pose, a material.
inline std::string visual(const std::string& name, const std::string& geometry,
                          const std::string& more = {}) {
    return "<visual name=\"" + name + "\">" + more + "<geometry>" + geometry +
           "</geometry></visual>\n";
}

inline const std::string unit_box = "<box><size>1 1 1</size></box>";

inline std::string mesh_of(const std::string& uri) {
    return "<mesh><uri>" + uri + "</uri></mesh>";
}

inline const std::string triangle_obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl oak\nf 1 2 3\n";

}  // namespace scipd::sim
