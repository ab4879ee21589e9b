// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// parse_document() of section.h.
#include <sstream>

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include "daemon/config/section.h"

namespace scipd::daemon {
namespace {

/// Hears a document and keeps only where it began.
class DocumentStart : public YAML::EventHandler {
  public:
    int line = 0;

  private:
    using Text = const std::string&;
    using Style = YAML::EmitterStyle::value;
    using Anchor = YAML::anchor_t;
    void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark&, Anchor) override {}
    void OnAlias(const YAML::Mark&, Anchor) override {}
    void OnScalar(const YAML::Mark&, Text, Anchor, Text) override {}
    void OnSequenceStart(const YAML::Mark&, Text, Anchor, Style) override {}
    void OnSequenceEnd() override {}
    void OnMapStart(const YAML::Mark&, Text, Anchor, Style) override {}
    void OnMapEnd() override {}
};

/// Not by YAML::LoadAll(): in yaml-cpp 0.7 it never ends on `!tag,`.
void refuse_second_document(const std::string& text, Faults& faults) {
    std::istringstream stream{text};
    YAML::Parser parser{stream};
    DocumentStart start;
    if (parser.HandleNextDocument(start) && parser.HandleNextDocument(start)) {
        faults.add(start.line, {}, "a second YAML document; keep one");
    }
}

}  // namespace

YAML::Node parse_document(const std::string& text, Faults& faults) {
    try {
        auto document = YAML::Load(text);
        refuse_second_document(text, faults);
        return document.IsNull() ? YAML::Node{YAML::NodeType::Map} : document;
    } catch (const YAML::DeepRecursion& error) {
        faults.add(error.mark.line + 1, {}, "nested too deeply to be a configuration");
    } catch (const YAML::Exception& error) {
        const bool star = error.msg == YAML::ErrorMsg::ALIAS_NOT_FOUND;
        const std::string advice = star ? R"(; a star by itself needs quotes: "*")" : "";
        faults.add(error.mark.line + 1, {}, "not YAML: " + error.msg + advice);
    }
    faults.throw_if_any();
    return {};
}

}  // namespace scipd::daemon
