// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/backends/egl_context.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "sim/backends/depth.h"

namespace scipd::sim {
namespace {

bool has_word(const char* words, std::string_view wanted) {
    std::istringstream rest{words ? words : ""};
    const std::istream_iterator<std::string> end;
    return std::find(std::istream_iterator<std::string>{rest}, end, wanted) != end;
}

std::string error_name(EGLint error) {
    switch (error) {
        case EGL_NOT_INITIALIZED:
            return "it cannot be initialised; is a driver installed?";
        case EGL_BAD_ALLOC:
            return "out of memory";
        case EGL_BAD_MATCH:
            return "OpenGL 4.5 core is not offered";
        case EGL_BAD_ACCESS:
            return "it is in use on another thread";
        default:
            break;
    }
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "EGL error 0x%04x", static_cast<unsigned>(error));
    return text.data();
}

std::runtime_error refusal(const EglPlace& place, const std::string& why) {
    return std::runtime_error("EGL " + place.name + ": " + why);
}

/// libepoxy ends the program where a library that it looks for is not there, so somebody has to
/// look first.
void require_libraries() {
    for (const auto& [library, package] :
         {std::pair{"libEGL.so.1", "libegl1"}, std::pair{"libOpenGL.so.0", "libopengl0"}}) {
        if (dlopen(library, RTLD_LAZY | RTLD_LOCAL)) continue;  // stays open, as libepoxy has it
        throw std::runtime_error(std::string("there is no ") + library +
                                 " on this machine (Debian's package " + package + ")");
    }
}

EGLDisplay display_at(const EglPlace& place) {
    if (place.device)
        return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, place.device, nullptr);
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

/// Displays stay initialised until the program ends: they are shared by all contexts, and EGL does
/// not count who still needs them.
EGLDisplay open_display(const EglPlace& place) {
    EGLDisplay display = display_at(place);
    if (display == EGL_NO_DISPLAY) throw refusal(place, "there is no such display");
    if (!eglInitialize(display, nullptr, nullptr)) throw refusal(place, error_name(eglGetError()));
    const char* offered = eglQueryString(display, EGL_EXTENSIONS);
    for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"}) {
        if (!has_word(offered, needed)) throw refusal(place, std::string("it lacks ") + needed);
    }
    return display;
}

EGLContext open_context(const EglPlace& place, EGLDisplay display) {
    constexpr std::array<EGLint, 7> wanted{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    if (!eglBindAPI(EGL_OPENGL_API)) throw refusal(place, "it offers no OpenGL");
    EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
    if (context == EGL_NO_CONTEXT) throw refusal(place, error_name(eglGetError()));
    return context;
}

std::string text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

int number_of(GLenum name) {
    GLint number = 0;
    glGetIntegerv(name, &number);
    return number;
}

EglDescription describe(EGLDisplay display) {
    return {.egl = std::string(eglQueryString(display, EGL_VERSION)) + ", " +
                   eglQueryString(display, EGL_VENDOR),
            .renderer = text_of(GL_RENDERER),
            .opengl = text_of(GL_VERSION),
            .largest_picture_px = number_of(GL_MAX_RENDERBUFFER_SIZE),
            .viewports = number_of(GL_MAX_VIEWPORTS),
            .sub_pixel_bits = number_of(GL_SUBPIXEL_BITS)};
}

std::vector<EglPlace> devices() {
    std::array<EGLDeviceEXT, 32> handles{};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(static_cast<EGLint>(handles.size()), handles.data(), &count)) return {};
    std::vector<EglPlace> places;
    for (int i = 0; i < count; ++i) {
        const char* extensions = eglQueryDeviceStringEXT(handles[i], EGL_EXTENSIONS);
        places.push_back({"device " + std::to_string(i),
                          has_word(extensions, "EGL_MESA_device_software"), handles[i]});
    }
    return places;
}

}  // namespace

// Mesa reads these when its first driver starts; what a user has set stays. Worker threads cost
// more than they help with pictures as small as ours (1000 pixels of a maze: 0.29 ms without, 0.45
// ms with one), and a cache of shaders on disk is for programs that have many.
void prepare_drivers() {
    setenv("LP_NUM_THREADS", "0", 0);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

bool EglDescription::software() const {
    return renderer.starts_with("llvmpipe") || renderer.starts_with("softpipe");
}

std::vector<EglPlace> egl_places() {
    require_libraries();
    prepare_drivers();
    const char* offered = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<EglPlace> places;
    if (has_word(offered, "EGL_MESA_platform_surfaceless")) places.push_back({"surfaceless"});
    const bool lists_devices = has_word(offered, "EGL_EXT_device_base") ||
                               (has_word(offered, "EGL_EXT_device_query") &&
                                has_word(offered, "EGL_EXT_device_enumeration"));
    if (lists_devices && has_word(offered, "EGL_EXT_platform_device")) {
        for (EglPlace& place : devices())
            places.push_back(std::move(place));
    }
    if (places.empty()) {
        throw std::runtime_error(
            "EGL offers neither its surfaceless nor its device platform on this machine (Debian's "
            "package libgl1-mesa-dri brings both)");
    }
    return places;
}

EglContext::EglContext(const EglPlace& place)
    : place_(place), display_(open_display(place)), context_(open_context(place, display_)) {
    try {
        bind();
        description_ = describe(display_);
    } catch (...) {
        eglDestroyContext(display_, context_);
        throw;
    }
}

EglContext::~EglContext() {
    release();
    eglDestroyContext(display_, context_);
}

bool EglContext::bound() const {
    // Which API's context is the current one is a setting of each thread.
    return eglBindAPI(EGL_OPENGL_API) && eglGetCurrentContext() == context_;
}

void EglContext::release() {
    if (bound()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

void EglContext::bind() {
    if (bound()) return;
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        throw refusal(place_, error_name(eglGetError()));
}

unsigned EglContext::program(unsigned (*make)()) {
    bind();
    if (program_ == 0) program_ = make();
    return program_;
}

}  // namespace scipd::sim
