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

/// The elements that lie right in an element, or those of them with this name:
/// for (const XMLElement& link : Children(model, "link")) ...
class Children {
  public:
    explicit Children(const tinyxml2::XMLElement& outer, const char* name = nullptr)
        : first_(outer.FirstChildElement(name)), name_(name) {}

    class Iterator {
      public:
        Iterator(const tinyxml2::XMLElement* at, const char* name) : at_(at), name_(name) {}
        const tinyxml2::XMLElement& operator*() const { return *at_; }
        bool operator!=(const Iterator& other) const { return at_ != other.at_; }
        Iterator& operator++() {
            at_ = at_->NextSiblingElement(name_);
            return *this;
        }

      private:
        const tinyxml2::XMLElement* at_;
        const char* name_;
    };
    [[nodiscard]] Iterator begin() const { return {first_, name_}; }
    [[nodiscard]] Iterator end() const { return {nullptr, name_}; }

  private:
    const tinyxml2::XMLElement* first_;
    const char* name_;
};

/// The first element of the second name in the first of the first name in `outer`, and so on. Null
/// if one of them is missing.
const tinyxml2::XMLElement* inside(const tinyxml2::XMLElement& outer,
                                   std::initializer_list<const char*> names);

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
