// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/mesh/collada_primitive.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "sim/loaders/mesh/polygon_with_holes.h"

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

/// The corners of a polygon with holes: its time grows with the cube of this number at worst.
constexpr std::size_t most_corners = 1000;
constexpr std::string_view xml_blanks = " \t\r\n";

bool is(const XMLElement& element, std::string_view name) {
    return name == element.Name();
}

template <typename Number>
std::vector<Number> numbers_in(const XMLElement& element) {
    std::vector<Number> numbers;
    std::string_view rest = element.GetText() == nullptr ? "" : element.GetText();
    for (;;) {
        rest.remove_prefix(std::min(rest.find_first_not_of(xml_blanks), rest.size()));
        if (rest.empty()) return numbers;
        Number number{};
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        if (error != std::errc{}) {
            throw std::runtime_error("has a <" + std::string{element.Name()} +
                                     "> that holds more than numbers");
        }
        numbers.push_back(number);
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    }
}

void set_numbers(XMLElement& element, const Loop& numbers) {
    std::string text;
    for (const auto number : numbers)
        text.append(text.empty() ? "" : " ").append(std::to_string(number));
    element.SetText(text.c_str());
}

/// The <input> with this semantic; null if there is none.
XMLElement* input_of(XMLElement& element, std::string_view semantic) {
    for (auto* input = element.FirstChildElement("input"); input != nullptr;
         input = input->NextSiblingElement("input")) {
        if (input->Attribute("semantic", std::string{semantic}.c_str()) != nullptr) return input;
    }
    return nullptr;
}

void keep_one_input(XMLElement& element, const XMLElement* wanted) {
    for (auto* input = element.FirstChildElement("input"); input != nullptr;) {
        auto* next = input->NextSiblingElement("input");
        if (input != wanted) element.DeleteChild(input);
        input = next;
    }
}

/// The child of the mesh whose id is the reference without its '#'; null if there is none.
XMLElement* find(XMLElement& mesh, const char* reference) {
    for (auto* child = mesh.FirstChildElement(); child != nullptr && reference != nullptr;
         child = child->NextSiblingElement()) {
        const char* id = child->Attribute("id");
        if (id != nullptr && *reference == '#' && std::string_view{reference + 1} == id)
            return child;
    }
    return nullptr;
}

std::vector<glm::dvec3> positions_in(XMLElement& source) {
    auto* array = source.FirstChildElement("float_array");
    auto* technique = source.FirstChildElement("technique_common");
    auto* accessor = technique == nullptr ? nullptr : technique->FirstChildElement("accessor");
    if (array == nullptr || accessor == nullptr) return {};
    const auto stride = accessor->UnsignedAttribute("stride", 1);
    const auto first = accessor->UnsignedAttribute("offset", 0);
    const auto numbers = numbers_in<double>(*array);
    std::vector<glm::dvec3> positions;
    for (std::size_t at = first; stride >= 3 && at + 3 <= numbers.size(); at += stride)
        positions.emplace_back(numbers[at], numbers[at + 1], numbers[at + 2]);
    return positions;
}

/// A corner has `stride` numbers. The one at `offset` is the index of its position.
struct Corner {
    std::size_t offset = 0;
    std::size_t stride = 1;
};

Corner corner_of(XMLElement& primitive, const XMLElement& vertex) {
    Corner corner{vertex.UnsignedAttribute("offset", 0)};
    for (auto* input = primitive.FirstChildElement("input"); input != nullptr;
         input = input->NextSiblingElement("input")) {
        corner.stride = std::max<std::size_t>(
            corner.stride, input->UnsignedAttribute("offset", 0) + std::size_t{1});
    }
    return corner;
}

Loop corners_in(const XMLElement& list, const Corner& corner) {
    const Loop all = numbers_in<std::size_t>(list);
    Loop corners;
    for (std::size_t at = corner.offset; at < all.size(); at += corner.stride)
        corners.push_back(all[at]);
    return corners;
}

class MeshRelief {
  public:
    explicit MeshRelief(XMLElement& mesh) : mesh_(mesh) {}

    void run() {
        auto* vertices = mesh_.FirstChildElement("vertices");
        auto* position = vertices == nullptr ? nullptr : input_of(*vertices, "POSITION");
        if (position == nullptr) return;
        source_ = find(mesh_, position->Attribute("source"));
        keep_one_input(*vertices, position);
        for (auto* child = mesh_.FirstChildElement(); child != nullptr;) {
            auto* next = child->NextSiblingElement();
            if (auto* vertex = input_of(*child, "VERTEX")) relieve(*child, *vertex);
            if (is(*child, "source") && child != source_) mesh_.DeleteChild(child);
            child = next;
        }
    }

  private:
    void relieve(XMLElement& primitive, XMLElement& vertex) {
        const Corner corner = corner_of(primitive, vertex);
        keep_one_input(primitive, &vertex);
        vertex.SetAttribute("offset", 0);
        std::size_t corners = 0;
        std::size_t lists = 0;
        const auto relieve_list = [&](XMLElement& list) {
            const Loop kept = corners_in(list, corner);
            corners += kept.size();
            ++lists;
            set_numbers(list, kept);
        };
        if (is(primitive, "polygons")) fill(primitive, vertex, corner);
        for (auto* list = primitive.FirstChildElement("p"); list != nullptr;
             list = list->NextSiblingElement("p")) {
            relieve_list(*list);
        }
        auto* sizes = primitive.FirstChildElement("vcount");
        if (is(primitive, "triangles")) lists = corners / 3;
        if (sizes != nullptr) lists = numbers_in<std::size_t>(*sizes).size();
        primitive.SetAttribute("count", static_cast<std::uint64_t>(lists));
    }

    /// Replaces polygons that have holes with triangles, in an element beside this one.
    void fill(XMLElement& polygons, const XMLElement& vertex, const Corner& corner) {
        std::vector<std::array<std::size_t, 3>> triangles;
        for (auto* child = polygons.FirstChildElement(); child != nullptr;) {
            auto* next = child->NextSiblingElement();
            // COLLADA has holes in a <ph>, with the outline. Some writers put them after a <p>.
            const bool is_outline = is(*child, "p") && next != nullptr && is(*next, "h");
            if (is(*child, "ph") || is_outline) {
                auto* outline = is_outline ? child : child->FirstChildElement("p");
                if (outline != nullptr) append(*outline, corner, triangles);
                while (is_outline && next != nullptr && is(*next, "h")) {
                    auto* hole = next;
                    next = next->NextSiblingElement();
                    polygons.DeleteChild(hole);
                }
                polygons.DeleteChild(child);
            }
            child = next;
        }
        if (!triangles.empty()) put_beside(polygons, vertex, triangles);
    }

    void append(XMLElement& outline, const Corner& corner,
                std::vector<std::array<std::size_t, 3>>& triangles) {
        if (positions_.empty() && source_ != nullptr) positions_ = positions_in(*source_);
        std::vector<Loop> loops;
        std::size_t corners = 0;
        for (auto* list = &outline; list != nullptr; list = list->NextSiblingElement()) {
            if (list != &outline && !is(*list, "h")) break;
            loops.push_back(corners_in(*list, corner));
            corners += loops.back().size();
            if (std::ranges::any_of(loops.back(),
                                    [&](std::size_t at) { return at >= positions_.size(); })) {
                throw std::runtime_error("has a polygon whose corners are not there");
            }
        }
        if (corners > most_corners) {
            throw std::runtime_error("has a polygon with holes of more than " +
                                     std::to_string(most_corners) + " corners; triangulate it");
        }
        const auto more = triangles_of(loops[0], {loops.begin() + 1, loops.end()}, positions_);
        triangles.insert(triangles.end(), more.begin(), more.end());
    }

    void put_beside(XMLElement& polygons, const XMLElement& vertex,
                    const std::vector<std::array<std::size_t, 3>>& triangles) {
        auto& document = *mesh_.GetDocument();
        auto* beside = document.NewElement("triangles");
        mesh_.InsertAfterChild(&polygons, beside);
        if (const char* material = polygons.Attribute("material")) {
            beside->SetAttribute("material", material);
        }
        beside->SetAttribute("count", static_cast<std::uint64_t>(triangles.size()));
        beside->InsertEndChild(vertex.ShallowClone(&document));
        Loop corners;
        for (const auto& triangle : triangles)
            corners.insert(corners.end(), triangle.begin(), triangle.end());
        set_numbers(*beside->InsertNewChildElement("p"), corners);
    }

    XMLElement& mesh_;
    XMLElement* source_ = nullptr;
    std::vector<glm::dvec3> positions_;
};

}  // namespace

void relieve_collada_mesh(XMLElement& mesh) {
    MeshRelief{mesh}.run();
}

}  // namespace scipd::sim
