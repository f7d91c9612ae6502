// SPDX-License-Identifier: MIT
#include "risorius/design/conditions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/readable_text.h"

namespace risorius::design {

namespace {

constexpr std::size_t kMaxClipName = 100;

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool holds(const std::vector<Given>& when, const Parameters& values) {
    return std::all_of(when.begin(), when.end(), [&](const Given& one) {
        return values.has(one.name) && values.at(one.name) == one.value.json();
    });
}

bool holds(const std::map<std::string, Json>& when, const Parameters& values) {
    return std::all_of(when.begin(), when.end(), [&](const auto& one) {
        return values.has(one.first) && values.at(one.first) == one.second;
    });
}

void append_word(std::string word, std::string& name) {
    if (!name.empty() && !word.empty())
        word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    name += word;
}

bool is_drawn(const ConditionSet& set, const std::string& name) {
    return std::any_of(set.factors.begin(), set.factors.end(),
                       [&](const Factor& factor) { return factor.drawn && factor.name == name; });
}

/// A number with four significant digits, without an exponent.
std::string four_digits(const Json& value) {
    if (!value.is_number()) return json_text(value);
    const double number = value.get<double>();
    const int decimals =
        number == 0 ? 0 : 3 - static_cast<int>(std::floor(std::log10(std::abs(number))));
    const double unit = std::pow(10.0, decimals);
    return format_number(std::round(number * unit) / unit);
}

/// The words of a clip's name: text of the pattern, and values by `word_of`. Each is converted by clip_word(), so that signs and points
/// become letters.
std::string words_of_name(const ConditionSet& set,
                          const std::function<std::string(const std::string& name)>& word_of) {
    std::string out;
    const std::string place = set.place + "/clip";
    for (std::size_t i = 0; i < set.clip.size();) {
        if (set.clip.compare(i, 2, "${") != 0) {
            const std::size_t end = std::min(set.clip.find("${", i), set.clip.size());
            append_word(clip_word(set.clip.substr(i, end - i)), out);
            i = end;
            continue;
        }
        const std::size_t end = set.clip.find('}', i);
        if (end == std::string::npos)
            throw Error(place, "${name of a parameter}", risorius::in_quotes(set.clip.substr(i)));
        const std::string name = set.clip.substr(i + 2, end - i - 2);
        append_word(clip_word(word_of(name)), out);
        i = end + 1;
    }
    return out;
}

std::string clip_name(const ConditionSet& set, const Parameters& values) {
    const std::string place = set.place + "/clip";
    const std::string out = words_of_name(set, [&](const std::string& name) {
        return is_drawn(set, name) ? four_digits(values.at(name))
                                   : values.filled_text("${" + name + "}", place);
    });
    if (out.empty())
        throw Error(place, "a name with letters or digits", risorius::in_quotes(set.clip));
    if (out.size() > kMaxClipName)
        throw Error(place, "a name of " + std::to_string(kMaxClipName) + " letters at most",
                    risorius::in_quotes(out));
    return out;
}

/// Sets the recording. A condition has none if the value is null or empty text.
void add_sound(const ConditionSet& set, const Parameters& values, Condition& condition) {
    if (!set.audio) return;
    const Json file = values.filled(*set.audio);
    if (file.is_null() || file == "") return;
    if (!file.is_string()) set.audio->fail("the name of a file", json_text(file));
    condition.audio = set.audio->folder() / file.get<std::string>();
    if (!set.audio_start_s) return;
    const Json start = values.filled(*set.audio_start_s);
    if (!start.is_number()) set.audio_start_s->fail("a number", json_text(start));
    condition.audio_start_s = start.get<double>();
}

int rounds_of(const MotionMatch& motion) { return !motion.share.empty() && motion.apex_s ? 2 : 1; }

/// ", expression happiness, seen_step 0.25": the levels of a condition, for messages.
std::string levels_text(const ConditionSet& set, const Parameters& values) {
    std::string out;
    for (const Factor& factor : set.factors)
        out += ", " + factor.name + " " + readable_text(values.text(factor.name));
    return out;
}

/// The values of the parameters of match/motion in a condition; 1 and the time of the apex when nothing can find them. What is seen at
/// the apex and when it is there depend on one another a little, so that they are found twice.
std::vector<Given> matched_motion(const Design& design, const ConditionSet& set,
                                  const std::vector<Given>& given, const MotionSearch& search) {
    const MotionMatch& motion = *design.match.motion;
    const bool steps = !motion.share.empty();
    double intensity = 1, time_s = motion.apex_s.value_or(0);
    const auto found = [&] {
        std::vector<Given> out;
        const auto add = [&](const std::string& name, double value) {
            out.push_back({name, JsonCursor::from_json(json_number(value), set.place)});
        };
        if (steps) add(motion.of, intensity);
        if (motion.apex_s) add(motion.apex_of, time_s);
        return out;
    };
    if (!search.intensity) return found();
    const auto all = [&] {
        std::vector<Given> out = given;
        for (Given& one : found()) out.push_back(std::move(one));
        return Parameters(out);
    };
    const auto script_with = [&](double& changed) {
        return [&](double value) {
            const double before = changed;
            changed = value;
            const Json script = all().filled(set.script);
            changed = before;
            return script;
        };
    };
    const std::string place = set.place + levels_text(set, all());
    for (int round = 0; round < rounds_of(motion); ++round) {
        if (steps)
            intensity = search.intensity(all().at(kSeenStep).get<double>(), script_with(intensity),
                                         set.script.folder(), place);
        if (motion.apex_s)
            time_s = search.time_s(*motion.apex_s, script_with(time_s), set.script.folder(), place);
    }
    return found();
}

/// The values of a condition, from what is given before the overrides.
Parameters values_of(const Design& design, const ConditionSet& set, std::vector<Given> given,
                     const MotionSearch& search) {
    const Parameters before(given);
    for (const Override& one : set.overrides)
        if (holds(one.when, before)) given.insert(given.end(), one.set.begin(), one.set.end());
    if (design.match.motion) {
        const MotionMatch& motion = *design.match.motion;
        for (const Given& one : given)
            if ((!motion.share.empty() && one.name == motion.of) ||
                (motion.apex_s && one.name == motion.apex_of))
                throw Error(one.value.place(),
                            "no value of " + in_quotes(one.name) + ", which match/motion finds",
                            json_text(one.value.json()));
        for (Given& one : matched_motion(design, set, given, search))
            given.push_back(std::move(one));
    }
    return Parameters(given);
}

/// What is given for the lower half of a chimeric clip.
std::vector<Given> with_lower(std::vector<Given> given, const Control& control,
                              const Parameters& values) {
    for (const auto& [name, value] : control.lower) {
        index_of_name(value.place(), name, values.names());
        given.push_back({name, value});
    }
    return given;
}

/// Adds a clip and checks that its name is unique, also without regard to case.
class Names {
  public:
    void add(const std::string& clip, const std::string& place) {
        const auto [other, is_new] = taken_.emplace(lower_case(clip), place);
        if (!is_new)
            throw Error(place, "a name that no other clip has; put what differs into \"clip\"",
                        risorius::in_quotes(clip) + ", as in " + other->second);
    }
    bool has(const std::string& clip) const { return taken_.count(lower_case(clip)) > 0; }

  private:
    std::map<std::string, std::string> taken_;
};

/// The neutral faces of a set. The face of a head at rest, in one view and for one length, is one clip for all conditions.
class Neutrals {
  public:
    /// Returns whether the face of this control is new. Otherwise the clip that shows it keeps only the values that both have.
    bool add(const Condition& neutral, std::size_t at, std::vector<Condition>& all) {
        const Json key = {neutral.script, neutral.folder.string(),
                          neutral.audio ? neutral.audio->string() : "", neutral.audio_start_s};
        const auto [like, is_new] = first_.emplace(json_text(key), at);
        if (is_new) {
            shared_[at] = false;
            return true;
        }
        Condition& shared = all[like->second];
        shared_[like->second] = true;
        std::erase_if(shared.values, [&](const auto& value) {
            return std::find(neutral.values.begin(), neutral.values.end(), value) ==
                   neutral.values.end();
        });
        return false;
    }
    /// Names each clip that several conditions share by what they have in common, and claims the names of all.
    void name(const ConditionSet& set, std::vector<Condition>& all, Names& names) const {
        for (const auto& [at, is_shared] : shared_) {
            Condition& neutral = all[at];
            const auto word_of = [&](const std::string& name) -> std::string {
                for (const auto& [known, value] : neutral.values)
                    if (known == name) {
                        if (value.is_string()) return value.get<std::string>();
                        return is_drawn(set, name) ? four_digits(value) : json_text(value);
                    }
                return {};
            };
            if (is_shared) {
                std::string common = words_of_name(set, word_of);
                append_word(neutral.control.name(), common);
                if (!names.has(common)) neutral.clip = common;
            }
            names.add(neutral.clip, set.place + ", control " + neutral.control.name());
        }
    }

  private:
    std::map<std::string, std::size_t> first_;  ///< what a face depends on, and its clip
    std::map<std::size_t, bool> shared_;        ///< clip, and whether several conditions share it
};

/// The character of UTF-8 at `at`, which is not ASCII, in letters and digits of ASCII: the base letter of an accented Latin letter,
/// else "u" and its code. Moves `at` to its last byte.
std::string ascii_word(const std::string& text, std::size_t& at) {
    const std::size_t size = character_size(std::string_view(text).substr(at));
    if (size < 2) return "";
    unsigned code = static_cast<unsigned char>(text[at]) & (0xffu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i)
        code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3fu);
    at += size - 1;
    // U+00C0 to U+00FF; the signs of multiplication and division are no letters
    constexpr std::string_view kBase =
        "AAAAAAACEEEEIIIIDNOOOOO*OUUUUYTsaaaaaaaceeeeiiiidnooooo*ouuuuyty";
    if (code >= 0xC0 && code <= 0xFF && kBase[code - 0xC0] != '*')
        return std::string(1, kBase[code - 0xC0]);
    char word[16];
    std::snprintf(word, sizeof word, "u%04x", code);
    return word;
}

/// Throws Error when an override or a control asks for a parameter that no condition of the set has.
void check_when(const Design& design, const ConditionSet& set) {
    std::vector<std::string> names{"set"};
    const auto add = [&](const std::vector<Given>& given) {
        for (const Given& one : given) names.push_back(one.name);
    };
    add(design.parameters);
    add(set.parameters);
    for (const std::vector<Given>& row : set.rows) add(row);
    for (const Factor& factor : set.factors) names.push_back(factor.name);
    for (const Override& one : set.overrides) add(one.set);
    if (design.match.motion) {
        if (!design.match.motion->share.empty()) names.push_back(design.match.motion->of);
        if (design.match.motion->apex_s) names.push_back(design.match.motion->apex_of);
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (const Override& one : set.overrides)
        for (const Given& asked : one.when) index_of_name(asked.value.place(), asked.name, names);
    for (const Control& control : set.controls)
        for (const auto& [name, value] : control.when)
            index_of_name(set.place + ", control " + control.name() + "/when", name, names);
}

}  // namespace

std::string clip_word(const std::string& text) {
    std::string out;
    bool capital = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const bool digit_after =
            i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1]));
        const bool digit_before = i > 0 && std::isdigit(static_cast<unsigned char>(text[i - 1]));
        if (std::isalnum(static_cast<unsigned char>(c))) {
            out += capital && !out.empty()
                       ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
                       : c;
            capital = false;
        } else if (c == '.' && digit_before && digit_after) {
            out += 'p';
        } else if (c == '-' && i == 0 && digit_after) {
            out += 'm';
        } else if (static_cast<unsigned char>(c) >= 0x80) {
            out += ascii_word(text, i);
        } else {
            capital = true;
        }
    }
    return out;
}

long motion_searches(const Design& design) {
    if (!design.match.motion) return 0;
    const MotionMatch& motion = *design.match.motion;
    long sets = 0;
    for (const ConditionSet& set : design.sets) {
        const auto lower = std::count_if(
            set.controls.begin(), set.controls.end(),
            [](const Control& control) { return control.kind == ControlKind::kChimeric; });
        sets += static_cast<long>(wanted_conditions(set, design.seed).size()) * (1 + lower);
    }
    return sets * rounds_of(motion) * ((motion.share.empty() ? 0 : 1) + (motion.apex_s ? 1 : 0));
}

std::vector<Condition> conditions_of(const Design& design, const MotionSearch& search) {
    long all = 0;
    std::vector<std::vector<long>> wanted;
    for (const ConditionSet& set : design.sets) {
        wanted.push_back(wanted_conditions(set, design.seed));
        all += static_cast<long>(wanted.back().size() * (1 + set.controls.size()));
        if (all > kMaxConditions)
            throw Error(design.file.string() + ":/sets",
                        std::to_string(kMaxConditions) + " clips at most", "more");
    }
    std::vector<Condition> out;
    Names names;
    for (std::size_t s = 0; s < design.sets.size(); ++s) {
        const ConditionSet& set = design.sets[s];
        check_when(design, set);
        Neutrals neutrals;
        for (const long index : wanted[s]) {
            std::vector<Given> given = design.parameters;
            given.push_back({"set", JsonCursor::from_json(set.name, set.place)});
            given.insert(given.end(), set.parameters.begin(), set.parameters.end());
            const std::vector<int> levels = levels_of(set, index);
            const std::vector<Given>& row = set.rows[static_cast<std::size_t>(levels[0])];
            given.insert(given.end(), row.begin(), row.end());
            for (std::size_t f = 0; f < set.factors.size(); ++f)
                given.push_back({set.factors[f].name,
                                 set.factors[f].levels[static_cast<std::size_t>(levels[f + 1])]});
            const Parameters values = values_of(design, set, given, search);

            Condition condition;
            condition.clip = condition.of = clip_name(set, values);
            condition.set = set.name;
            for (const std::string& name : values.names())
                condition.values.emplace_back(name, values.at(name));
            Json script = values.filled(set.script);
            if (set.sample) {
                condition.units = set.trials[static_cast<std::size_t>(levels[0])].units;
                script = with_units(std::move(script), condition.units, set.sample->length_s,
                                    set.script.place());
            }
            condition.script = script;
            condition.folder = set.script.folder();
            add_sound(set, values, condition);
            const std::string place = set.place + ", condition " + std::to_string(index + 1) +
                                      " (" + condition.clip + ")";
            names.add(condition.clip, place);
            out.push_back(condition);
            for (const Control& control : set.controls) {
                if (!holds(control.when, values)) continue;
                Condition beside = condition;
                beside.control = control;
                append_word(control.name(), beside.clip);
                beside.script = controlled(script, control);
                if (control.kind == ControlKind::kChimeric)
                    beside.lower_script =
                        values_of(design, set, with_lower(given, control, values), search)
                            .filled(set.script);
                if (control.kind == ControlKind::kNeutral) {
                    if (neutrals.add(beside, out.size(), out)) out.push_back(std::move(beside));
                    continue;
                }
                // The seed depends only on the name, so that other conditions do not change it.
                std::seed_seq seed(beside.clip.begin(), beside.clip.end());
                std::array<unsigned, 1> drawn_seed{};
                seed.generate(drawn_seed.begin(), drawn_seed.end());
                beside.seed = drawn_seed[0] ^ static_cast<unsigned>(design.seed);
                names.add(beside.clip, place + ", control " + control.name());
                out.push_back(std::move(beside));
            }
        }
        neutrals.name(set, out, names);
    }
    return out;
}

}  // namespace risorius::design
