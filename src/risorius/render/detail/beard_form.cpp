// SPDX-License-Identifier: MIT
#include "risorius/render/detail/beard_form.h"

#include <vector>

#include "risorius/core/known_names.h"
#include "risorius/render/detail/names_of.h"
#include "risorius/render/hair_styles.h"

namespace risorius::render {
namespace {

constexpr std::array<BeardForm, 5> kBeardForms{{
    {"stubble", {true, true, true, true, true, true, true, true, false}, 1.0, false},
    {"full", {true, true, true, true, true, true, true, true, true}, 1.3, true},
    {"moustache", {false, false, true, true, false, false, false, false, false}, 1.15, true},
    {"goatee", {true, true, true, true, false, false, false, false, true}, 1.05, true},
    {"jawline", {true, true, false, false, true, true, true, true, false}, 1.15, true},
}};

}  // namespace

const std::vector<std::string>& beard_form_names() {
    static const std::vector<std::string> names = names_of(kBeardForms);
    return names;
}

const BeardForm& beard_form(const std::string& name) {
    return kBeardForms[index_of_name("beard_form", name, beard_form_names())];
}

}  // namespace risorius::render
