// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/line_for_line.h"

#include <algorithm>
#include <cstddef>

#include <tinyxml2.h>

namespace scipd::sim {
namespace {

using tinyxml2::XMLElement;

class LinePrinter : public tinyxml2::XMLPrinter {
  public:
    LinePrinter() : XMLPrinter(nullptr, true) {}

    bool VisitEnter(const XMLElement& element, const tinyxml2::XMLAttribute* first) override {
        // The tag before is still open: a line break there is only white space.
        while (line_ < element.GetLineNum())
            Putc('\n');
        return XMLPrinter::VisitEnter(element, first);
    }

  protected:
    void Write(const char* data, std::size_t size) override {
        line_ += static_cast<int>(std::count(data, data + size, '\n'));
        XMLPrinter::Write(data, size);
    }
    void Putc(char c) override {
        line_ += c == '\n' ? 1 : 0;
        XMLPrinter::Putc(c);
    }

  private:
    int line_ = 1;
};

}  // namespace

std::string line_for_line(const tinyxml2::XMLDocument& document) {
    LinePrinter printer;
    document.Accept(&printer);
    return printer.CStr();
}

}  // namespace scipd::sim
