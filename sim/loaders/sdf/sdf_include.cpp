// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// How the reader follows an <include>.
#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/loaders/file/xml_tree.h"
#include "sim/loaders/parts/frames.h"
#include "sim/loaders/sdf/sdf_reader.h"
#include "sim/text/quote.h"
#include "sim/text/text_number.h"

namespace scipd::sim {
namespace {

constexpr std::size_t deepest_include = 32;
constexpr std::string_view model_frame = "__model__";

/// Makes names that mean the model itself mean the frame that stands for it.
class Redirect {
  public:
    explicit Redirect(const std::string& frame) : frame_(frame) {}

    void part(SdfPart& part) const {
        const bool is_fixed = part.kind == SdfPart::Kind::frame;
        if (is_fixed ? means_model(part.attached_to) : part.attached_to == model_frame) {
            part.attached_to = frame_;
        }
        // A frame or a joint is where it is fixed to, unless it says otherwise.
        const bool is_placed =
            part.kind == SdfPart::Kind::link || part.kind == SdfPart::Kind::model;
        pose(part.pose, is_placed);
        for (SdfSurface& surface : part.surfaces)
            pose(surface.pose, false);
    }

  private:
    static bool means_model(const std::string& name) { return name.empty() || name == model_frame; }

    void pose(GivenPose& given, bool by_default) const {
        if (by_default ? means_model(given.relative_to) : given.relative_to == model_frame) {
            given.relative_to = frame_;
        }
    }

    const std::string& frame_;
};

/// libsdformat calls it so.
SdfPart frame_of(const SdfPart& model, const SdfPart& outer) {
    SdfPart frame{SdfPart::Kind::frame, "_merged__" + model.name + "__model__", model.place,
                  model.pose};
    if (frame.pose.relative_to.empty()) {
        frame.pose.relative_to = outer.kind == SdfPart::Kind::world ? "world" : "__model__";
    }
    const auto link = std::ranges::find(model.parts, SdfPart::Kind::link, &SdfPart::kind);
    if (outer.kind == SdfPart::Kind::model && link != model.parts.end()) {
        frame.attached_to = model.canonical_link.empty() ? link->name : model.canonical_link;
    }
    return frame;
}

/// <include merge='true'>: puts the parts of `model` into `outer`, and a frame that stands for the
/// model. If its placement frame is none, nothing is merged, and the result says why.
std::string merge(SdfPart model, SdfPart& outer) {
    SdfPart frame = frame_of(model, outer);
    if (!model.placement_frame.empty()) {
        const auto placed = Frames(model).pose_of(model.placement_frame);
        if (!placed) return "its placement_frame is " + placed.error().why;
        frame.pose.pose = frame.pose.pose * inverse(*placed);
    }
    const Redirect redirect(frame.name);
    outer.parts.push_back(frame);
    for (SdfPart& part : model.parts) {
        redirect.part(part);
        outer.parts.push_back(std::move(part));
    }
    return {};
}

}  // namespace

using tinyxml2::XMLElement;

const SdfDocument* SdfReader::document_of(const XMLElement& include, const SdfSheet& sheet) {
    const std::string place = text_of(sheet.place(include)) + ": ";
    const auto uri = SdfValues(include, sheet.dialect).text("uri");
    const std::string trim{trimmed(uri.value_or(""))};
    if (trim.empty()) {
        draft_.leave_out(place + "an <include> has no <uri>");
        return nullptr;
    }
    const auto* document = documents_.included(trim, sheet, place);
    if (document == nullptr || !enter(*document, place)) return nullptr;
    const auto* params = include.FirstChildElement("experimental:params");
    if (params == nullptr) return document;
    parts_ += document->sheet.file->string().size();
    SdfDocument& changed = documents_.copy_of(*document, sheet.place(*params));
    auto* model = changed.root().FirstChildElement("model");
    if (model == nullptr) return &changed;
    apply_params(*params, *model, [&](const XMLElement& param, const std::string& why) {
        draft_.warn(text_of(sheet.place(param)) + ": <" + param.Name() +
                    "> of experimental:params: " + why + "; skipped");
    });
    return &changed;
}

bool SdfReader::enter(const SdfDocument& document, const std::string& place) {
    const auto same = [&](const SdfDocument* open) {
        // By another way, too: over a symbolic link.
        std::error_code none;
        return *open->sheet.file == *document.sheet.file ||
               std::filesystem::equivalent(*open->sheet.file, *document.sheet.file, none);
    };
    if (std::ranges::any_of(open_, same)) {
        draft_.leave_out(place + "includes itself" +
                         (same(open_.back()) ? "" : ", through others"));
        return false;
    }
    if (open_.size() < deepest_include) return true;
    draft_.leave_out(place + "includes are nested more than " + std::to_string(deepest_include) +
                     " deep");
    return false;
}

void SdfReader::read_include(const XMLElement& include, const SdfSheet& sheet, SdfPart& outer) {
    const SdfDocument* document = document_of(include, sheet);
    if (document == nullptr) return;
    const bool merges = include.BoolAttribute("merge");
    const bool in_world = outer.kind == SdfPart::Kind::world;
    open_.push_back(document);
    const auto* world = document->root().FirstChildElement("world");
    if (merges && in_world && world != nullptr) {
        read_parts(*world, document->sheet, outer);
        open_.pop_back();
        return;
    }
    auto model = model_in(*document, text_of(include.FirstChildElement("name")));
    open_.pop_back();
    // A lamp, for example, is nothing to a scanner.
    if (!model && world != nullptr) {
        draft_.leave_out(text_of(sheet.place(include)) + ": " + document->sheet.file->string() +
                         " holds a world, and a model is wanted here");
    }
    if (!model) return;
    place_include(include, sheet, *model);
    // A world has no links: a model that has some stays one.
    const bool has_links =
        std::ranges::find(model->parts, SdfPart::Kind::link, &SdfPart::kind) != model->parts.end();
    if (!merges || (in_world && has_links)) return outer.parts.push_back(std::move(*model));
    const std::string place = place_of(include, sheet, names_, model->name);
    const std::string why = merge(std::move(*model), outer);
    if (!why.empty()) draft_.leave_out(place + why);
}

void SdfReader::place_include(const XMLElement& include, const SdfSheet& sheet, SdfPart& model) {
    const SdfValues values(include, sheet.dialect);
    // Its name and its pose are told here.
    model.place = sheet.place(include);
    try {
        if (values.has_pose()) model.pose = values.pose();
    } catch (const UnreadableValue& value) {
        draft_.leave_out(place_of(include, sheet, names_, model.name) + value.what());
        model.parts.clear();
    }
    read_static(include, sheet, model);
    if (const auto frame = values.text("placement_frame")) model.placement_frame = *frame;
}

}  // namespace scipd::sim
