// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The few words in which the loaders walk through a parsed XML document and take parts out of it.
// Any thread; one owner.
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

/// Empty where there is none.
std::string attribute(const tinyxml2::XMLElement& element, const char* name);

/// What it begins with, of an element or of none; empty where that is no text.
std::string text_of(const tinyxml2::XMLElement* element);

/// With all that lies in it, from the outside in; `visit` may change what is in there.
void for_each(tinyxml2::XMLElement& element,
              const std::function<void(tinyxml2::XMLElement&)>& visit);

void delete_children(tinyxml2::XMLElement& element,
                     const std::function<bool(tinyxml2::XMLElement&)>& is_unwanted);

}  // namespace scipd::sim
