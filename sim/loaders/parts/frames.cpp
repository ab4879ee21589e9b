// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/parts/frames.h"

#include <string>
#include <utility>

#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

constexpr std::string_view colons = "::";

/// What its pose is relative to where its element does not say; empty: to the model or the world.
std::string_view reference_of(const SdfPart& part) {
    if (!part.pose.relative_to.empty()) return part.pose.relative_to;
    const bool is_fixed = part.kind == SdfPart::Kind::frame || part.kind == SdfPart::Kind::joint;
    return is_fixed ? std::string_view{part.attached_to} : std::string_view{};
}

/// It lies where it says, in the model or the world itself.
bool lies_right_in(const SdfPart& part) {
    return part.kind != SdfPart::Kind::joint && part.attached_to.empty() &&
           part.placement_frame.empty() && reference_of(part).empty();
}

}  // namespace

Frames::Frames(const SdfPart& outer) : outer_(outer) {
    for (const SdfPart& part : outer.parts) {
        if (!part.sensor && !part.name.empty()) parts_.emplace(part.name, &part);
    }
}

bool Frames::is_itself(std::string_view name) const {
    return name.empty() || name == (outer_.kind == SdfPart::Kind::world ? "world" : "__model__");
}

const SdfPart* Frames::find(std::string_view name) const {
    const auto found = parts_.find(name);
    return found == parts_.end() ? nullptr : found->second;
}

Expected<Pose> Frames::pose_of(std::string_view name) {
    // A part may be called `world` itself.
    if (const SdfPart* part = find(name)) {
        auto pose = pose_of(*part);
        if (pose) return pose;
        return refuse(quote(name, whole_path) + ", which lies nowhere");
    }
    if (is_itself(name)) return Pose{};
    const auto [model, rest] = into_model(name);
    if (model == nullptr) return refuse(quote(name, whole_path) + ", which is no frame");
    const auto here = pose_of(*model);
    const auto inside = nested(*model).pose_of(rest);
    if (!here) return refuse(quote(name, whole_path) + ", which lies nowhere");
    if (!inside) return inside;
    return *here * *inside;
}

std::pair<const SdfPart*, std::string_view> Frames::into_model(std::string_view name) const {
    for (auto at = name.find(colons); at != name.npos; at = name.find(colons, at + 1)) {
        const SdfPart* model = find(name.substr(0, at));
        if (model != nullptr && model->kind == SdfPart::Kind::model) {
            return {model, name.substr(at + colons.size())};
        }
    }
    return {nullptr, name};
}

Frames& Frames::nested(const SdfPart& model) {
    auto& frames = nested_[&model];
    if (!frames) frames = std::make_unique<Frames>(model);
    return *frames;
}

bool Frames::is_there(std::string_view name) {
    if (find(name) != nullptr || is_itself(name)) return true;
    const auto [model, rest] = into_model(name);
    return model != nullptr && nested(*model).is_there(rest);
}

Expected<Pose> Frames::pose_of(const SdfPart& part) {
    if (lies_right_in(part)) return part.pose.pose;  // as most do, and takes no memory
    // From its far end: so no chain is too long for the stack.
    std::vector<const SdfPart*> chain;
    const auto is_circle = [&] { return chain.size() > outer_.parts.size(); };
    for (const auto* at = &part; at != nullptr && !known_.contains(at) && !is_circle();
         at = next_of(*at)) {
        chain.push_back(at);
    }
    if (is_circle()) known_.emplace(chain.back(), refuse("its pose leads in a circle"));
    for (; !chain.empty(); chain.pop_back()) {
        if (known_.contains(chain.back())) continue;
        auto pose = found(*chain.back());
        known_.emplace(chain.back(), std::move(pose));
    }
    return known_.at(&part);
}

const SdfPart* Frames::next_of(const SdfPart& part) const {
    if (lies_right_in(part)) return nullptr;
    const std::string_view name = reference_of(part);
    const SdfPart* next = find(name);
    return next == nullptr ? into_model(name).first : next;
}

Expected<Pose> Frames::found(const SdfPart& part) {
    if (part.kind == SdfPart::Kind::joint && part.attached_to.empty())
        return refuse("has no <child>");
    // A frame that is fixed to nothing is none, even if it says where it lies.
    if (!is_there(part.attached_to)) {
        return refuse("it is attached to " + quote(part.attached_to, whole_path) +
                      ", which is no frame");
    }
    const auto reference = pose_of(reference_of(part));
    if (!reference) return refuse("its pose is relative to " + reference.error().why);
    const auto placed_in = placed(part);
    if (!placed_in) return placed_in;
    return *reference * *placed_in;
}

/// With its placement frame at the pose that it gives.
Expected<Pose> Frames::placed(const SdfPart& part) {
    if (part.placement_frame.empty()) return part.pose.pose;
    const auto frame = nested(part).pose_of(part.placement_frame);
    if (!frame) return refuse("its placement_frame is " + frame.error().why);
    return part.pose.pose * inverse(*frame);
}

Expected<Pose> Frames::in_link(const SdfPart& link, const GivenPose& given) {
    if (given.relative_to.empty()) return given.pose;
    const auto reference = pose_of(given.relative_to);
    if (!reference) return refuse("its pose is relative to " + reference.error().why);
    const auto here = pose_of(link);
    if (!here) return here;
    return inverse(*here) * *reference * given.pose;
}

const SdfPart* Frames::link_under(const SdfPart& frame) const {
    const SdfPart* part = &frame;
    for (std::size_t i = 0; i <= outer_.parts.size() && part != nullptr; ++i) {
        if (part->kind == SdfPart::Kind::link) return part;
        if (part->kind == SdfPart::Kind::model) return nullptr;
        part = find(part->attached_to);
    }
    return nullptr;
}

}  // namespace scipd::sim
