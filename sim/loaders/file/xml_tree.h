// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Helpers with which the loaders walk through a parsed XML document and delete parts of it. Any
// thread; one owner.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include <tinyxml2.h>

namespace scipd::sim {

template <typename Names>
bool is_one_of(const tinyxml2::XMLElement& element, const Names& names) {
    return std::ranges::find(names, std::string_view{element.Name()}) != names.end();
}

inline bool is_one_of(const tinyxml2::XMLElement& element,
                      std::initializer_list<std::string_view> names) {
    return is_one_of<std::initializer_list<std::string_view>>(element, names);
}

/// Empty if the element has no such attribute.
std::string attribute(const tinyxml2::XMLElement& element, const char* name);

/// The text that the element begins with. Empty if it begins with something else, or is null.
std::string text_of(const tinyxml2::XMLElement* element);

/// Visits the element and then all elements inside it, outer ones first. `visit` may change what is
/// inside the element that it gets.
void for_each(tinyxml2::XMLElement& element,
              const std::function<void(tinyxml2::XMLElement&)>& visit);

void delete_children(tinyxml2::XMLElement& element,
                     const std::function<bool(tinyxml2::XMLElement&)>& is_unwanted);

}  // namespace scipd::sim
