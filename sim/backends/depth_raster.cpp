// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/depth_raster.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace scipd::sim {
namespace {

/// The eye is subtracted before anything is turned: far from the anchor that keeps what is near the
/// eye exact.
constexpr const char* vertex_shader = R"(#version 450 core
layout(location = 0) in vec3 position_m;
layout(location = 1) in uint triangle;
layout(location = 0) uniform vec3 eye_m;
layout(location = 1) uniform mat4 clip_from_eye;
flat out uint drawn_triangle;
void main() {
    gl_Position = clip_from_eye * vec4(position_m - eye_m, 1.0);
    drawn_triangle = triangle;
}
)";
constexpr const char* fragment_shader = R"(#version 450 core
flat in uint drawn_triangle;
layout(location = 0) out uint shown_triangle;
void main() { shown_triangle = drawn_triangle; }
)";
constexpr int eye_location = 0;
constexpr int clip_location = 1;

static_assert(sizeof(DrawnTriangle) == 3 * sizeof(std::uint32_t), "an index buffer's three");

unsigned compiled(GLenum kind, const char* source) {
    const unsigned shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(std::string("OpenGL refuses a shader: ") + log.data());
}

unsigned linked_program() {
    const unsigned program = glCreateProgram();
    for (const unsigned shader : {compiled(GL_VERTEX_SHADER, vertex_shader),
                                  compiled(GL_FRAGMENT_SHADER, fragment_shader)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) throw std::runtime_error("OpenGL does not link the shaders");
    return program;
}

/// Measured with llvmpipe: strips of one row cost a third less than with none.
constexpr glm::ivec2 margin_px{256, 256};

}  // namespace

DrawnView drawn_view(const PlannedView& view, const Pose& anchored_from_sensor,
                     std::size_t first_triangle, std::size_t triangle_count) {
    const glm::dmat4 sensor_from_anchored =
        glm::mat4_cast(glm::conjugate(anchored_from_sensor.rotation));
    return {
        .corner_px = view.corner_px,
        .size_px = view.strip.size_px,
        .margin_px = margin_px,
        .eye_m = anchored_from_sensor.translation_m,
        .clip_from_eye = clip_from_sensor(widened(view.strip, margin_px)) * sensor_from_anchored,
        .first_triangle = first_triangle,
        .triangle_count = triangle_count};
}

DepthRaster::DepthRaster(std::shared_ptr<EglContext> context) : context_(std::move(context)) {
    program_ = context_->program(linked_program);
    glCreateVertexArrays(1, &vertex_array_);
    glCreateBuffers(1, &vertices_);
    glCreateBuffers(1, &indices_);
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(DrawnVertex));
    glVertexArrayElementBuffer(vertex_array_, indices_);
    for (const unsigned attribute : {0U, 1U}) {
        glEnableVertexArrayAttrib(vertex_array_, attribute);
        glVertexArrayAttribBinding(vertex_array_, attribute, 0);
    }
    glVertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE,
                              offsetof(DrawnVertex, position_m));
    glVertexArrayAttribIFormat(vertex_array_, 1, 1, GL_UNSIGNED_INT,
                               offsetof(DrawnVertex, triangle));
    glCreateFramebuffers(1, &frame_);
}

DepthRaster::~DepthRaster() {
    try {
        context_->bind();
    } catch (const std::runtime_error&) {
        return;  // on a wrong thread; the context takes its objects along when it goes
    }
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(1, &depth_);
    glDeleteRenderbuffers(1, &triangle_);
    glDeleteBuffers(1, &vertices_);
    glDeleteBuffers(1, &indices_);
    glDeleteVertexArrays(1, &vertex_array_);
}

void DepthRaster::set_vertices(std::span<const DrawnVertex> vertices) {
    context_->bind();
    glNamedBufferData(vertices_, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
                      GL_DYNAMIC_DRAW);
}

void DepthRaster::replace_vertices(std::size_t first, std::span<const DrawnVertex> vertices) {
    context_->bind();
    glNamedBufferSubData(vertices_, static_cast<GLintptr>(first * sizeof(DrawnVertex)),
                         static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data());
}

void DepthRaster::make_picture(glm::ivec2 size_px) {
    const glm::ivec2 largest_px = glm::max(drawable_px_, size_px);
    drawable_px_ = {0, 0};  // until it is there
    glDeleteRenderbuffers(1, &depth_);
    glDeleteRenderbuffers(1, &triangle_);
    glCreateRenderbuffers(1, &depth_);
    glCreateRenderbuffers(1, &triangle_);
    glNamedRenderbufferStorage(depth_, GL_DEPTH_COMPONENT32F, largest_px.x, largest_px.y);
    glNamedRenderbufferStorage(triangle_, GL_R32UI, largest_px.x, largest_px.y);
    if (glGetError() != GL_NO_ERROR)
        throw std::runtime_error("OpenGL has no room for a picture of " +
                                 std::to_string(largest_px.x) + " x " +
                                 std::to_string(largest_px.y) + " pixels");
    glNamedFramebufferRenderbuffer(frame_, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    glNamedFramebufferRenderbuffer(frame_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, triangle_);
    if (glCheckNamedFramebufferStatus(frame_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("OpenGL cannot draw depth as 32-bit floats beside whole numbers");
    drawable_px_ = largest_px;
}

void DepthRaster::draw(std::span<const DrawnView> views, std::span<const DrawnTriangle> triangles,
                       glm::ivec2 size_px) {
    context_->bind();
    drawn_px_ = size_px;
    if (glm::any(glm::greaterThan(size_px, drawable_px_))) make_picture(size_px);
    glNamedBufferData(indices_, static_cast<GLsizeiptr>(triangles.size_bytes()), triangles.data(),
                      GL_STREAM_DRAW);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glBindVertexArray(vertex_array_);
    glUseProgram(program_);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // reversed: near is 1, infinity is 0
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, size_px.x, size_px.y);
    constexpr float far_depth = 0.0F;
    glClearBufferfv(GL_DEPTH, 0, &far_depth);
    glClearBufferuiv(GL_COLOR, 0, &Picture::nothing);
    for (const DrawnView& view : views) {
        if (view.triangle_count == 0) continue;
        const glm::ivec2 corner_px = view.corner_px - view.margin_px;
        const glm::ivec2 projected_px = view.size_px + 2 * view.margin_px;
        glViewport(corner_px.x, corner_px.y, projected_px.x, projected_px.y);
        glScissor(view.corner_px.x, view.corner_px.y, view.size_px.x, view.size_px.y);
        glUniform3fv(eye_location, 1, glm::value_ptr(view.eye_m));
        glUniformMatrix4fv(clip_location, 1, GL_FALSE, glm::value_ptr(view.clip_from_eye));
        const std::size_t offset = view.first_triangle * sizeof(DrawnTriangle);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * view.triangle_count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(offset));
    }
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw std::runtime_error("OpenGL cannot draw: error " + std::to_string(error));
}

void DepthRaster::finish() {
    context_->bind();
    glFinish();
}

void DepthRaster::read(Picture& picture) {
    read_depth(picture);
    read_triangles(picture);
}

void DepthRaster::read_depth(Picture& picture) {
    picture.depth.resize(begin_reading(picture));
    glReadPixels(0, 0, drawn_px_.x, drawn_px_.y, GL_DEPTH_COMPONENT, GL_FLOAT,
                 picture.depth.data());
}

void DepthRaster::read_triangles(Picture& picture) {
    picture.triangle.resize(begin_reading(picture));
    glReadPixels(0, 0, drawn_px_.x, drawn_px_.y, GL_RED_INTEGER, GL_UNSIGNED_INT,
                 picture.triangle.data());
}

std::size_t DepthRaster::begin_reading(Picture& picture) {
    context_->bind();
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    picture.size_px = drawn_px_;
    return static_cast<std::size_t>(drawn_px_.x) * static_cast<std::size_t>(drawn_px_.y);
}

}  // namespace scipd::sim
