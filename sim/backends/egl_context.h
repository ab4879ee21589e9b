// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A way to draw without a screen: an OpenGL 4.5 core context on EGL's surfaceless platform or on a
// graphics device of the machine. Draws nothing itself. A context belongs to the thread
// that is bound to it, until it is released there.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace scipd::sim {

/// Where a context can be made: a platform of EGL, and which of its devices.
struct EglPlace {
    std::string name;        ///< "surfaceless" or "device N", for people
    bool software = false;   ///< a device that says itself that it is the processor
    void* device = nullptr;  ///< EGLDeviceEXT; null for surfaceless
};

/// What EGL and OpenGL say of themselves at one place.
struct EglDescription {
    std::string egl;       ///< version and vendor
    std::string renderer;  ///< of OpenGL, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string opengl;    ///< version
    int largest_picture_px = 0;
    int viewports = 0;
    int sub_pixel_bits = 0;

    /// Draws with the processor, which is how Mesa works where there is no graphics device.
    [[nodiscard]] bool software() const;
};

/// Every place that EGL offers, surfaceless first. Throws std::runtime_error with a sentence where
/// this machine has no EGL at all.
std::vector<EglPlace> egl_places();

class EglContext {
  public:
    /// Makes the context and binds it to this thread. Throws std::runtime_error with a sentence
    /// that names the place.
    explicit EglContext(const EglPlace& place);
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

    [[nodiscard]] const EglPlace& place() const { return place_; }
    [[nodiscard]] const EglDescription& description() const { return description_; }

    /// Whatever OpenGL is told next on this thread is told to this context. Throws
    /// std::runtime_error where another thread is bound to it.
    void bind();
    [[nodiscard]] bool bound() const;
    /// Where it is bound to this thread, any other may bind it next.
    void release();

    /// A program of OpenGL, for all who draw in this context: drivers translate it when it is first
    /// drawn with, which takes longer than all else that a picture needs. Bound here, made by the
    /// first who asks, and gone with the context.
    unsigned program(unsigned (*make)());

  private:
    EglPlace place_;
    EglDescription description_;
    void* display_ = nullptr;
    void* context_ = nullptr;
    unsigned program_ = 0;
};

}  // namespace scipd::sim
