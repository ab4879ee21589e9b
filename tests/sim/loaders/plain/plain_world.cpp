// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "tests/sim/loaders/plain/plain_world.h"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include <glm/trigonometric.hpp>
#include <tinyxml2.h>

namespace scipd::tests {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

std::vector<double> numbers(const std::string& text) {
    std::istringstream stream{text};
    std::vector<double> values;
    for (double value = 0.0; stream >> value;)
        values.push_back(value);
    return values;
}

glm::dvec3 vector_of(const std::string& text) {
    const auto values = numbers(text);
    if (values.size() != 3) throw std::runtime_error("three numbers are wanted: " + text);
    return {values[0], values[1], values[2]};
}

glm::dmat4 matrix_of(const glm::dvec3& xyz_m, const glm::dvec3& rpy_rad) {
    const glm::dvec3 s = glm::sin(rpy_rad);
    const glm::dvec3 c = glm::cos(rpy_rad);
    const glm::dmat3 about_x{1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x};
    const glm::dmat3 about_y{c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y};
    const glm::dmat3 about_z{c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1};
    glm::dmat4 matrix{about_z * about_y * about_x};
    matrix[3] = glm::dvec4{xyz_m, 1.0};
    return matrix;
}

std::string text_at(const XMLElement& element, const char* name, const std::string& otherwise) {
    const auto* child = element.FirstChildElement(name);
    return child == nullptr || child->GetText() == nullptr ? otherwise : child->GetText();
}

const XMLElement& child_of(const XMLElement& element, const char* name) {
    const auto* child = element.FirstChildElement(name);
    if (child == nullptr)
        throw std::runtime_error(std::string{element.Name()} + " without " + name);
    return *child;
}

/// SDF has six numbers in an element.
glm::dmat4 pose_of(const XMLElement& element) {
    const auto* pose = element.FirstChildElement("pose");
    if (pose == nullptr) return glm::dmat4{1.0};
    if (pose->Attribute("relative_to") != nullptr) throw std::runtime_error("relative_to");
    const auto v = numbers(pose->GetText());
    return matrix_of({v.at(0), v.at(1), v.at(2)}, {v.at(3), v.at(4), v.at(5)});
}

/// URDF has two attributes.
glm::dmat4 origin_of(const XMLElement& element) {
    const auto* origin = element.FirstChildElement("origin");
    if (origin == nullptr) return glm::dmat4{1.0};
    const auto attribute = [&](const char* name) {
        const char* text = origin->Attribute(name);
        return vector_of(text == nullptr ? "0 0 0" : text);
    };
    return matrix_of(attribute("xyz"), attribute("rpy"));
}

/// Vertices and faces of an OBJ file.
PlainTriangles triangles_of(const fs::path& file, const glm::dvec3& scale) {
    std::ifstream in{file};
    if (!in) throw std::runtime_error("no " + file.string());
    std::vector<glm::dvec3> vertices;
    PlainTriangles triangles;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words{line};
        std::string what;
        words >> what;
        if (what == "v") vertices.push_back(scale * vector_of(line.substr(1)));
        if (what != "f") continue;
        std::vector<std::size_t> corners;
        for (std::string corner; words >> corner;)
            corners.push_back(std::stoul(corner) - 1);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            triangles.push_back(
                {vertices.at(corners[0]), vertices.at(corners[i - 1]), vertices.at(corners[i])});
        }
    }
    return triangles;
}

class PlainReader {
  public:
    explicit PlainReader(fs::path file) : folder_(file.parent_path()) {
        if (document_.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) {
            throw std::runtime_error(document_.ErrorStr());
        }
    }

    PlainWorld run(const glm::dmat4& world_from_document) {
        const XMLElement& root = *document_.RootElement();
        if (root.Name() == std::string{"robot"}) {
            add_robot(root);
        } else if (const auto* world = root.FirstChildElement("world")) {
            add_models(*world, world_from_document);
        } else {
            add_models(root, world_from_document);
        }
        return std::move(things_);
    }

  private:
    void add_models(const XMLElement& outer, const glm::dmat4& world_from_outer) {
        for (const auto* model = outer.FirstChildElement("model"); model != nullptr;
             model = model->NextSiblingElement("model")) {
            const glm::dmat4 world_from_model = world_from_outer * pose_of(*model);
            add_links(*model, world_from_model);
            add_models(*model, world_from_model);
        }
        for (const auto* include = outer.FirstChildElement("include"); include != nullptr;
             include = include->NextSiblingElement("include")) {
            add_include(*include, world_from_outer);
        }
    }

    /// Its own pose takes the place of the model's.
    void add_include(const XMLElement& include, const glm::dmat4& world_from_outer) {
        const std::string scheme = "model://";
        const std::string uri = text_at(include, "uri", "");
        const auto file = folder_ / uri.substr(uri.starts_with(scheme) ? scheme.size() : 0);
        PlainReader reader{file / "model.sdf"};
        XMLElement& model = *reader.document_.RootElement()->FirstChildElement("model");
        if (const auto* pose = include.FirstChildElement("pose")) {
            if (auto* own = model.FirstChildElement("pose")) model.DeleteChild(own);
            model.InsertEndChild(pose->DeepClone(&reader.document_));
        }
        const PlainWorld things = reader.run(world_from_outer);
        things_.insert(things_.end(), things.begin(), things.end());
    }

    void add_links(const XMLElement& model, const glm::dmat4& world_from_model) {
        for (const auto* link = model.FirstChildElement("link"); link != nullptr;
             link = link->NextSiblingElement("link")) {
            const glm::dmat4 world_from_link = world_from_model * pose_of(*link);
            for (const auto* visual = link->FirstChildElement("visual"); visual != nullptr;
                 visual = visual->NextSiblingElement("visual")) {
                things_.push_back(
                    {world_from_link * pose_of(*visual), shape_of(child_of(*visual, "geometry"))});
                if (const auto* plane = child_of(*visual, "geometry").FirstChildElement("plane")) {
                    if (vector_of(text_at(*plane, "normal", "0 0 1")) != glm::dvec3{0, 0, 1}) {
                        throw std::runtime_error("a plane that is not level");
                    }
                }
            }
        }
    }

    [[nodiscard]] PlainShape shape_of(const XMLElement& geometry) const {
        const XMLElement& shape = *geometry.FirstChildElement();
        const std::string kind = shape.Name();
        const auto number = [&](const char* name) {
            return numbers(text_at(shape, name, "")).at(0);
        };
        if (kind == "box") return PlainBox{0.5 * vector_of(text_at(shape, "size", ""))};
        if (kind == "sphere") return PlainSphere{number("radius")};
        if (kind == "cylinder") return PlainCylinder{number("radius"), 0.5 * number("length")};
        if (kind == "plane") {
            const auto size_m = numbers(text_at(shape, "size", ""));
            return PlainRectangle{{0.5 * size_m.at(0), 0.5 * size_m.at(1)}};
        }
        if (kind != "mesh") throw std::runtime_error("no shape known as " + kind);
        return triangles_of(folder_ / text_at(shape, "uri", ""),
                            vector_of(text_at(shape, "scale", "1 1 1")));
    }

    void add_robot(const XMLElement& robot) {
        std::map<std::string, const XMLElement*> joint_of_child;
        for (const auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
             joint = joint->NextSiblingElement("joint")) {
            joint_of_child[child_of(*joint, "child").Attribute("link")] = joint;
        }
        for (const auto* link = robot.FirstChildElement("link"); link != nullptr;
             link = link->NextSiblingElement("link")) {
            glm::dmat4 robot_from_link{1.0};
            for (auto at = joint_of_child.find(link->Attribute("name"));
                 at != joint_of_child.end();) {
                const XMLElement& joint = *at->second;
                robot_from_link = origin_of(joint) * robot_from_link;
                at = joint_of_child.find(child_of(joint, "parent").Attribute("link"));
            }
            for (const auto* visual = link->FirstChildElement("visual"); visual != nullptr;
                 visual = visual->NextSiblingElement("visual")) {
                things_.push_back({robot_from_link * origin_of(*visual),
                                   robot_shape_of(child_of(*visual, "geometry"))});
            }
        }
    }

    [[nodiscard]] PlainShape robot_shape_of(const XMLElement& geometry) const {
        const XMLElement& shape = *geometry.FirstChildElement();
        const std::string kind = shape.Name();
        if (kind == "box") return PlainBox{0.5 * vector_of(shape.Attribute("size"))};
        if (kind == "sphere") return PlainSphere{shape.DoubleAttribute("radius")};
        if (kind == "cylinder") {
            return PlainCylinder{shape.DoubleAttribute("radius"),
                                 0.5 * shape.DoubleAttribute("length")};
        }
        if (kind != "mesh") throw std::runtime_error("no shape known as " + kind);
        const char* scale = shape.Attribute("scale");
        return triangles_of(folder_ / shape.Attribute("filename"),
                            vector_of(scale == nullptr ? "1 1 1" : scale));
    }

    fs::path folder_;
    tinyxml2::XMLDocument document_;
    PlainWorld things_;
};

}  // namespace

PlainWorld read_plain_world(const fs::path& file) {
    return PlainReader{file}.run(glm::dmat4{1.0});
}

}  // namespace scipd::tests
