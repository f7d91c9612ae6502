// SPDX-License-Identifier: MIT
#include "risorius/fitting/part_guess.h"

#include <algorithm>
#include <cctype>

namespace risorius::fitting {

namespace {

// Splits a name into words: "EyeBall_L" -> "eye", "ball", "l"
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words(1);
    bool was_lower = false;
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (!std::isalpha(letter) || (std::isupper(letter) && was_lower))
            if (!words.back().empty()) words.emplace_back();
        if (std::isalpha(letter)) words.back() += static_cast<char>(std::tolower(letter));
        was_lower = std::islower(letter) != 0;
    }
    return words;
}

struct Name {
    explicit Name(const std::string& group) : words(words_of(group)) {
        for (const std::string& word : words) joined += word;
    }
    bool has(std::initializer_list<const char*> parts) const {
        return std::any_of(parts.begin(), parts.end(), [&](const char* part) {
            return joined.find(part) != std::string::npos;
        });
    }
    bool has_word(std::initializer_list<const char*> list) const {
        return std::any_of(list.begin(), list.end(), [&](const char* word) {
            return std::find(words.begin(), words.end(), word) != words.end();
        });
    }
    std::string side() const {
        if (has({"left"}) || has_word({"l", "lt"})) return "_l";
        if (has({"right"}) || has_word({"r", "rt"})) return "_r";
        return "";
    }
    std::string level() const {
        if (has({"upper"}) || has_word({"up", "top"})) return "_upper";
        if (has({"lower"}) || has_word({"low", "down", "bottom"})) return "_lower";
        return "";
    }

    std::vector<std::string> words;
    std::string joined;
};

}  // namespace

std::string role_suggested_by(const std::string& group) {
    const Name name(group);
    // Thin sheets around the eye, and everything made of hair: neither drawn nor moved.
    if (name.has({"lacrimal", "occlusion", "eyeblend", "caruncle", "meniscus", "tearline", "brow",
                  "hair", "beard", "shadow", "cloth", "shirt", "glasses"}))
        return "hidden";
    // MetaHuman, VRoid, Daz: shells around the eye, and strokes drawn on it
    if (name.has({"eyeshell", "eyeedge", "saliva", "cartilage", "highlight", "eyeline", "moisture",
                  "reflection", "tearduct"}))
        return "hidden";
    if (name.has({"lash"})) return "lashes" + name.side();
    if (name.has({"socket"})) return name.has({"eye"}) ? "eye_socket" : "mouth";
    if (name.has({"cornea"})) return "cornea" + name.side();
    if (name.has({"teeth", "tooth"})) return "teeth" + name.level();
    const bool gums = name.has({"gum", "gingiva"}), tongue = name.has({"tongue"});
    if (gums && tongue) return "gums_tongue";
    if (gums) return "gums" + name.level();
    if (tongue) return "tongue";
    if (name.has({"eyelid", "lips"})) return "skin";
    if (name.has({"mouth", "oral"})) return "mouth";
    if (name.has({"eye", "sclera", "iris", "pupil"})) return "eye" + name.side();
    const bool face = name.has({"face"}) && !name.has({"surface"});
    if (face || name.has({"skin", "head", "neck", "body", "bust", "torso"}) ||
        name.has_word({"nose", "ear", "ears", "cheek", "chin", "forehead"}))
        return "skin";
    // MakeHuman names eyeballs after how finely they are made, and the body after its base mesh.
    if (name.has({"highpoly", "lowpoly"})) return "eye";
    if (name.joined == "base" || name.joined == "basemesh" || name.joined == "human") return "skin";
    return "";
}

PartGuess guess_parts(const geom::PolygonMesh& mesh,
                      const std::map<std::string, std::vector<std::string>>& given,
                      const std::function<double(const Vec3& mesh_units)>& left_of) {
    PartGuess guess;
    guess.parts = given;
    const auto is_given = [&](const std::string& group) {
        return std::any_of(given.begin(), given.end(), [&](const auto& part) {
            return std::find(part.second.begin(), part.second.end(), group) != part.second.end();
        });
    };
    const auto middle_of = [&](int group) {
        Vec3 sum = Vec3::Zero();
        int corners = 0;
        for (int f = 0; f < mesh.face_count(); ++f) {
            if (mesh.face_group[static_cast<std::size_t>(f)] != group) continue;
            for (int c = mesh.face_begin[static_cast<std::size_t>(f)];
                 c < mesh.face_begin[static_cast<std::size_t>(f) + 1]; ++c, ++corners)
                sum +=
                    mesh.positions.row(mesh.corner_vertex[static_cast<std::size_t>(c)]).transpose();
        }
        return corners ? Vec3(sum / corners) : sum;
    };
    for (std::size_t g = 0; g < mesh.group_names.size(); ++g) {
        const std::string& group = mesh.group_names[g];
        if (is_given(group)) continue;
        std::string role = mesh.group_names.size() == 1 ? "skin" : role_suggested_by(group);
        if (role == "eye" || role == "cornea") {
            role += left_of(middle_of(static_cast<int>(g))) > 0 ? "_l" : "_r";
            guess.notes.push_back("group \"" + group + "\" taken as " + role +
                                  ", by where it lies");
        }
        if (role.empty()) {
            role = "hidden";
            guess.notes.push_back(
                "group \"" + group +
                "\" is hidden: its name says no part (the option part gives it one: role=" + group +
                ")");
        }
        guess.parts[role].push_back(group);
    }
    return guess;
}

}  // namespace risorius::fitting
