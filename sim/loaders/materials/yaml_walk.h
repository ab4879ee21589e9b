// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Walks through the YAML of a library of materials and collects what is wrong with it. Knows maps,
// lists, lines and keys, not what a library means. One thread at a time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace scipd::sim {

/// A value and where it stands. The line is that of the key, since the value of an alias stands
/// elsewhere.
struct YamlField {
    std::string path;  ///< "materials.wood.reflectance"
    std::string key;
    int line = 1;
    YAML::Node value;
};

class YamlWalk {
  public:
    /// `file` names the document in faults.
    explicit YamlWalk(std::string file) : file_(std::move(file)) {}

    /// Throws LoadError where the text is no YAML.
    [[nodiscard]] YamlField document(const std::string& text) const;

    /// Throws LoadError with all faults where there are too many to be of use, which also bounds
    /// the work that a hostile file can cause.
    void add_fault(const YamlField& field, const std::string& text);
    [[nodiscard]] std::size_t fault_count() const { return faults_.size(); }
    /// Throws LoadError if there are faults.
    void throw_if_any() const;

    /// The entries of a map of 1 to 4096, in the order of the file. What is none gets the fault
    /// `otherwise`, and a key that is no plain name or is given twice gets one, too.
    std::vector<YamlField> entries(const YamlField& map, const char* otherwise);
    /// The texts of a list. What is none gets the fault `otherwise`.
    std::vector<std::string> texts(const YamlField& list, const char* otherwise);

  private:
    std::string file_;
    std::vector<std::string> faults_;
};

}  // namespace scipd::sim
