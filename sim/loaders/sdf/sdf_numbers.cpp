// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
#include "sim/loaders/sdf/sdf_numbers.h"

#include <initializer_list>
#include <locale>
#include <sstream>

#include "sim/loaders/file/load_error.h"
#include "sim/text/quote.h"

namespace scipd::sim {
namespace {

void read(sdf::Element& element, std::initializer_list<double*> numbers) {
    const auto text = element.Get<std::string>();
    std::istringstream rest{text};
    rest.imbue(std::locale::classic());
    for (double* number : numbers)
        rest >> *number;
    if (!rest.fail() && (rest >> std::ws).eof()) return;
    throw LoadError({"<" + element.GetName() + "> must hold " + std::to_string(numbers.size()) +
                     (numbers.size() == 1 ? " number" : " numbers") + ", not " + quote(text)});
}

}  // namespace

double number_of_child(sdf::Element& parent, const std::string& name, double otherwise) {
    const auto element = parent.FindElement(name);
    if (element) read(*element, {&otherwise});
    return otherwise;
}

glm::dvec3 vector_of(sdf::Element& element) {
    glm::dvec3 vector{0.0};
    read(element, {&vector.x, &vector.y, &vector.z});
    return vector;
}

}  // namespace scipd::sim
