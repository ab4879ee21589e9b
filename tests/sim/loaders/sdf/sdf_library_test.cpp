// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Random documents, read by scipd and by libsdformat: each link, frame and visual lies where the
// library has it. Built where the system has libsdformat 12.
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <sdf/sdf.hh>

#include "sim/loaders/sdf/sdf.h"
#include "tests/support/temp_dir.h"

namespace scipd::sim {
namespace {

using Poses = std::map<std::string, Pose>;

/// Writes documents that are sound: every name leads to something that was written before it.
class Writer {
  public:
    explicit Writer(unsigned seed) : dice_(seed) {}

    /// The names of models in files that may be included.
    std::string world(const std::vector<std::string>& files) {
        files_ = &files;
        version_ = pick({"1.7", "1.8", "1.9"});
        std::string text;
        Scope scope{"world"};
        for (int i = below(2); i > 0; --i)
            text += below(3) == 0 ? frame(scope) : part_of_world(scope);
        text += model(scope, 0);
        return sdf("<world name='w'>\n" + text + "</world>");
    }

    std::string model_file(const std::vector<std::string>& files) {
        files_ = &files;
        version_ = pick({"1.7", "1.8", "1.9"});
        Scope scope{"world"};
        // Alone, it is relative to nothing.
        return sdf(model(scope, 1, true));
    }

  private:
    /// What a part of one model may refer to.
    struct Scope {
        std::string itself;
        std::vector<std::string> names = {};
        std::vector<std::string> links = {};
    };

    int below(int n) { return static_cast<int>(dice_() % static_cast<unsigned>(n)); }
    std::string pick(const std::vector<std::string>& from) {
        return from[static_cast<std::size_t>(below(static_cast<int>(from.size())))];
    }
    std::string name(const std::string& kind) { return kind + std::to_string(count_++); }
    std::string number(double most) {
        return std::to_string(std::uniform_real_distribution<double>{-most, most}(dice_));
    }
    std::string sdf(const std::string& inside) const {
        return "<sdf version='" + version_ + "'>\n" + inside + "</sdf>";
    }

    std::string pose(const Scope& scope, bool may_refer = true) {
        if (below(4) == 0) return {};
        const std::string reference = may_refer && !scope.names.empty() && below(2) == 0
                                          ? " relative_to='" + pick(scope.names) + "'"
                                          : "";
        const std::string at = number(10) + ' ' + number(10) + ' ' + number(3) + ' ';
        if (version_ == "1.9" && below(4) == 0) {
            return "<pose" + reference + " rotation_format='quat_xyzw'>" + at +
                   "0.1 0.2 0.3 0.9273618495495703</pose>";
        }
        const bool in_degrees = version_ == "1.9" && below(3) == 0;
        const double most = in_degrees ? 180 : 3;
        return "<pose" + reference + (in_degrees ? " degrees='true'>" : ">") + at + number(most) +
               ' ' + number(most / 2) + ' ' + number(most) + "</pose>";
    }

    std::string frame(Scope& scope) {
        const std::string own = name("f");
        const std::string attached =
            scope.names.empty() || below(2) == 0 ? "" : " attached_to='" + pick(scope.names) + "'";
        std::string text =
            "<frame name='" + own + "'" + attached + ">" + pose(scope) + "</frame>\n";
        scope.names.push_back(own);
        return text;
    }

    std::string link(Scope& scope) {
        const std::string own = name("l");
        std::string text = "<link name='" + own + "'>" + pose(scope);
        // In a visual that is merged the library takes __model__ for the model that it comes into.
        Scope of_visuals = scope;
        std::erase(of_visuals.names, "__model__");
        for (int i = below(3); i > 0; --i) {
            text += "<visual name='" + name("v") + "'>" + pose(of_visuals) +
                    "<geometry><box><size>1 1 1</size></box></geometry></visual>";
        }
        scope.names.push_back(own);
        scope.links.push_back(own);
        return text + "</link>\n";
    }

    std::string joint(Scope& scope) {
        const std::string own = name("j");
        const std::string child = pick(scope.links);
        std::string text = "<joint name='" + own + "' type='fixed'>" + pose(scope) +
                           "<parent>world</parent><child>" + child + "</child></joint>\n";
        scope.names.push_back(own);
        return text;
    }

    std::string model(Scope& outer, int depth, bool is_alone = false) {
        const std::string own = name("m");
        Scope scope{"__model__", {"__model__"}};
        std::string text = link(scope);
        for (int i = below(4); i > 0; --i)
            text += part_of_model(scope, depth);
        const std::string placement =
            scope.names.size() > 1 && below(3) == 0
                ? " placement_frame='" +
                      scope.names[1 + static_cast<std::size_t>(
                                          below(static_cast<int>(scope.names.size()) - 1))] +
                      "'"
                : "";
        outer.names.push_back(own);
        // What lies in a nested model can be named from outside.
        if (!is_alone) outer.names.push_back(own + "::" + scope.links.front());
        return "<model name='" + own + "'" + placement + ">" + pose_before(outer, is_alone) + text +
               "</model>\n";
    }

    /// Relative to what was there before the model, whose own names are the last.
    std::string pose_before(const Scope& outer, bool is_alone) {
        Scope before = outer;
        before.names.resize(before.names.size() - (is_alone ? 1 : 2));
        return pose(before, !is_alone);
    }

    std::string include(Scope& scope, bool may_merge) {
        const std::string own = name("i");
        const bool merges = may_merge && below(2) == 0;
        std::string text = std::string{"<include"} + (merges ? " merge='true'" : "") + "><uri>" +
                           pick(*files_) + "</uri><name>" + own + "</name>" + pose(scope) +
                           "</include>\n";
        if (!merges) scope.names.push_back(own);
        return text;
    }

    std::string part_of_world(Scope& scope) {
        return files_->empty() || below(2) == 0 ? model(scope, 0) : include(scope, false);
    }

    std::string part_of_model(Scope& scope, int depth) {
        switch (below(files_->empty() ? 4 : 5)) {
            case 0:
                return frame(scope);
            case 1:
                return joint(scope);
            case 2:
                return depth < 1 + below(2) ? model(scope, depth + 1) : link(scope);
            case 3:
                return link(scope);
            default:
                return include(scope, true);
        }
    }

    std::mt19937 dice_;
    const std::vector<std::string>* files_ = nullptr;
    std::string version_;
    int count_ = 0;
};

Pose to_pose(const ignition::math::Pose3d& pose) {
    const auto& p = pose.Pos();
    const auto& q = pose.Rot();
    return {{p.X(), p.Y(), p.Z()}, glm::normalize(glm::dquat{q.W(), q.X(), q.Y(), q.Z()})};
}

Pose resolved(const sdf::SemanticPose& pose) {
    ignition::math::Pose3d here;
    EXPECT_TRUE(pose.Resolve(here).empty());
    return to_pose(here);
}

void add_library(const sdf::Model& model, const Pose& world_from_outer, const std::string& outer,
                 Poses& poses) {
    const std::string name = outer + model.Name();
    const Pose here = world_from_outer * resolved(model.SemanticPose());
    if (!outer.empty()) poses[name] = here;
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
        const auto& link = *model.LinkByIndex(i);
        const std::string link_name = name + "::" + link.Name();
        const Pose at_link = here * resolved(link.SemanticPose());
        poses[link_name] = at_link;
        for (std::uint64_t k = 0; k < link.VisualCount(); ++k) {
            const auto& visual = *link.VisualByIndex(k);
            poses[link_name + "::" + visual.Name()] = at_link * resolved(visual.SemanticPose());
        }
    }
    for (std::uint64_t i = 0; i < model.FrameCount(); ++i) {
        const auto& frame = *model.FrameByIndex(i);
        ignition::math::Pose3d in_model;
        EXPECT_TRUE(frame.SemanticPose().Resolve(in_model, "__model__").empty());
        poses[name + "::" + frame.Name()] = here * to_pose(in_model);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i)
        add_library(*model.ModelByIndex(i), here, name + "::", poses);
}

/// Learns what SDF consists of once: that takes the library a tenth of a second.
class Library {
  public:
    Library() {
        sdf::init(empty_);
        sdf::Console::Instance()->SetQuiet(true);
    }

    /// Nothing if it finds a fault.
    std::optional<sdf::Root> read(const std::string& text) const {
        const sdf::SDFPtr document{new sdf::SDF};
        document->Root(empty_->Root()->Clone());
        sdf::Errors errors;
        if (!sdf::readString(text, document, errors) || !errors.empty()) return std::nullopt;
        sdf::Root root;
        if (!root.Load(document).empty()) return std::nullopt;
        return root;
    }

  private:
    sdf::SDFPtr empty_{new sdf::SDF};
};

Poses ours(const Scene& scene) {
    Poses poses;
    for (const Frame& frame : scene.frames)
        poses[frame.name] = scene.models[frame.model].world_from_model * frame.model_from_frame;
    for (const Object& object : scene.objects)
        poses[object.name] = scene.models[object.model].world_from_model * object.model_from_object;
    return poses;
}

/// The library takes long, so that several run side by side.
class SdfLibrary : public ::testing::TestWithParam<unsigned> {};

INSTANTIATE_TEST_SUITE_P(Random, SdfLibrary, ::testing::Range(0U, 8U));

TEST_P(SdfLibrary, HasEverythingWhereScipdHasIt) {
    constexpr unsigned documents = 50;
    const tests::TempDir folder;
    // For includes within includes the library asks the global one alone.
    sdf::setFindCallback([&](const std::string& uri) { return (folder.path() / uri).string(); });
    const Library library;
    std::size_t compared = 0;
    std::size_t refused = 0;
    int exact = 0;
    for (unsigned seed = documents * GetParam(); seed < documents * (GetParam() + 1); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Writer writer(seed);
        std::vector<std::string> files;
        std::string all;
        for (const char* file : {"a.sdf", "b.sdf"}) {
            if (seed % 2 == 0 && !files.empty()) break;
            const std::string model = writer.model_file(files);
            folder.write(file, model);
            files.emplace_back(file);
            all += model;
        }
        const std::string text = writer.world(files);
        // The library writes the pose of what is merged with six digits, and reads it again.
        const bool merges = (all + text).find("merge=") != text.npos;
        const double tolerance = merges ? 1e-3 : 1e-9;
        exact += merges ? 0 : 1;
        const auto root = library.read(text);
        // The library finds faults that are none. Then nothing is compared.
        if (!root) {
            ++refused;
            continue;
        }
        Poses theirs;
        const auto& world = *root->WorldByIndex(0);
        for (std::uint64_t i = 0; i < world.ModelCount(); ++i)
            add_library(*world.ModelByIndex(i), {}, "", theirs);
        const LoadedScene loaded = load_sdf_text(text, "random", folder.path());
        const Poses mine = ours(*loaded.scene);
        ASSERT_EQ(mine.size(), theirs.size()) << text;
        for (const auto& [name, pose] : theirs) {
            const auto found = mine.find(name);
            ASSERT_NE(found, mine.end()) << name << "\n" << text << all;
            ASSERT_LT(glm::distance(found->second.translation_m, pose.translation_m), tolerance)
                << name << '\n'
                << text << all;
            ASSERT_LT(angle_between_rad(found->second.rotation, pose.rotation), 1e-7 + tolerance)
                << name << '\n'
                << text << all;
            ++compared;
        }
    }
    EXPECT_GT(compared, 4 * documents);
    EXPECT_LT(refused, documents / 5);
    EXPECT_GT(exact, static_cast<int>(documents) / 5);
}

}  // namespace
}  // namespace scipd::sim
