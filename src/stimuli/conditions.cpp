#include "stimuli/conditions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "core/error.h"

namespace risorius::stimuli {

namespace {

constexpr std::size_t kLongestClip = 100;

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

/// How many a set asks for before its controls. Throws Error when they are too many.
long crossing(const ConditionSet& set) {
    long count = static_cast<long>(set.rows.size());
    for (const Factor& factor : set.factors) {
        count *= static_cast<long>(factor.levels.size());
        if (count > kMostConditions)
            throw Error(set.place + "/factors",
                        std::to_string(kMostConditions) + " conditions at most", "more");
    }
    return count;
}

/// Which of the crossing are wanted, ascending.
std::vector<long> drawn(const ConditionSet& set, long count, int seed) {
    std::vector<long> out(static_cast<std::size_t>(count));
    for (long i = 0; i < count; ++i) out[static_cast<std::size_t>(i)] = i;
    if (!set.draw) return out;
    if (*set.draw > count)
        throw Error(set.place + "/draw",
                    "no more than the " + std::to_string(count) + " conditions there are",
                    std::to_string(*set.draw));
    std::mt19937 random(static_cast<unsigned>(seed));
    for (std::size_t i = out.size(); i > 1; --i) std::swap(out[i - 1], out[random() % i]);
    out.resize(static_cast<std::size_t>(*set.draw));
    std::sort(out.begin(), out.end());
    return out;
}

void append_word(std::string word, std::string& name) {
    if (!name.empty() && !word.empty())
        word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    name += word;
}

/// A clip's name, its words filled in one by one so that numbers and signs become letters.
std::string clip_name(const ConditionSet& set, const Parameters& values) {
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
            throw Error(place, "${name of a parameter}", risorius::quoted(set.clip.substr(i)));
        append_word(clip_word(values.filled_text(set.clip.substr(i, end + 1 - i), place)), out);
        i = end + 1;
    }
    if (out.empty())
        throw Error(place, "a name with letters or digits", risorius::quoted(set.clip));
    if (out.size() > kLongestClip)
        throw Error(place, "a name of " + std::to_string(kLongestClip) + " letters at most",
                    risorius::quoted(out));
    return out;
}

/// A clip that may not be named like another one, also where file names know no case.
class Names {
  public:
    void add(const std::string& clip, const std::string& place) {
        const auto [other, is_new] = taken_.emplace(lower_case(clip), place);
        if (!is_new)
            throw Error(place, "a name that no other clip has; put what differs into \"clip\"",
                        risorius::quoted(clip) + ", as in " + other->second);
    }

  private:
    std::map<std::string, std::string> taken_;
};

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
        } else {
            capital = true;
        }
    }
    return out;
}

std::vector<Condition> conditions_of(const Design& design) {
    long all = 0;
    for (const ConditionSet& set : design.sets) {
        const long wanted = set.draw ? *set.draw : crossing(set);
        all += wanted * static_cast<long>(1 + set.controls.size());
        if (all > kMostConditions)
            throw Error(design.file.string() + ":/sets",
                        std::to_string(kMostConditions) + " clips at most", "more");
    }
    std::vector<Condition> out;
    Names names;
    for (const ConditionSet& set : design.sets) {
        for (const long index : drawn(set, crossing(set), design.seed)) {
            std::vector<Given> given = design.parameters;
            given.push_back({"set", JsonCursor::from_json(set.name, set.place)});
            given.insert(given.end(), set.parameters.begin(), set.parameters.end());
            // The last factor changes fastest, the rows slowest
            long rest = index;
            std::vector<Given> levels;
            for (auto factor = set.factors.rbegin(); factor != set.factors.rend(); ++factor) {
                const auto count = static_cast<long>(factor->levels.size());
                levels.push_back(
                    {factor->name, factor->levels[static_cast<std::size_t>(rest % count)]});
                rest /= count;
            }
            const std::vector<Given>& row = set.rows[static_cast<std::size_t>(rest)];
            given.insert(given.end(), row.begin(), row.end());
            given.insert(given.end(), levels.rbegin(), levels.rend());
            const Parameters before(given);
            for (const Override& one : set.overrides)
                if (holds(one.when, before))
                    given.insert(given.end(), one.set.begin(), one.set.end());
            const Parameters values(given);

            Condition condition;
            condition.clip = condition.of = clip_name(set, values);
            condition.set = set.name;
            for (const std::string& name : values.names())
                condition.values.emplace_back(name, values.at(name));
            const Json script = values.filled(set.script);
            condition.script = script;
            condition.folder = set.script.folder();
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
                // By its name, so that other conditions do not change it
                std::seed_seq seed(beside.clip.begin(), beside.clip.end());
                std::array<unsigned, 1> drawn_seed{};
                seed.generate(drawn_seed.begin(), drawn_seed.end());
                beside.seed = drawn_seed[0] ^ static_cast<unsigned>(design.seed);
                names.add(beside.clip, place + ", control " + control.name());
                out.push_back(std::move(beside));
            }
        }
    }
    return out;
}

}  // namespace risorius::stimuli
