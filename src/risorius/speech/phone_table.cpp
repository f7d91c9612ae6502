// SPDX-License-Identifier: MIT
#include "risorius/speech/phone_table.h"

#include <algorithm>
#include <set>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/known_names.h"
#include "risorius/speech/detail/table_lines.h"

namespace risorius::speech {

namespace {

// The first part of a diphthong is longer; the closure of an affricate is shorter than its noise.
constexpr double kDiphthongFirst = 0.55, kAffricateClosure = 0.45;
constexpr double kLongRatio =
    1.9;  // long to short, Finnish; about 2 in most languages with quantity

const std::set<std::string, std::less<>> kSilences = {
    "",   "_",  "sil",   "SIL",  "sp",    "SP",   "spn", "SPN", "pau",   "PAU",  "#",
    "##", "h#", "<eps>", "<p:>", "<sil>", "ssil", "..",  "...", "noise", "<unk>"};

constexpr std::string_view kLong = "ː", kHalfLong = "ˑ", kPrimary = "ˈ", kSecondary = "ˌ";
constexpr std::string_view kTies[] = {"͡", "͜"};
// Marks of tone say nothing about the mouth.
constexpr std::string_view kTones[] = {"˥", "˦", "˧", "˨", "˩", "↗", "↘"};

/// Sets in which a label is one symbol, or several with spaces between; the others are written without spaces.
bool is_whole_word_set(const std::string& set) {
    return set == "arpabet" || set == "rhubarb" || set == "azure" || set == "polly" ||
           set == "oculus";
}

bool take(std::string_view& text, std::string_view begin) {
    if (!text.starts_with(begin)) return false;
    text.remove_prefix(begin.size());
    return true;
}

}  // namespace

const std::array<std::string_view, kParameterCount>& parameter_names() {
    static constexpr std::array<std::string_view, kParameterCount> names{
        "jaw_mm",     "gap_mm",         "width_mm",    "protrusion_mm",
        "tip_height", "tip_forward_mm", "body_height", "body_back"};
    return names;
}

const std::vector<std::string>& phone_class_names() {
    static const std::vector<std::string> names{
        "vowel",       "vowel_spread",     "vowel_round", "vowel_weak",     "closure",
        "labiodental", "labiodental_soft", "sibilant",    "sibilant_round", "round_cons",
        "tongue",      "tongue_tip",       "glide",       "neutral",        "silence"};
    return names;
}

bool is_vowel(PhoneClass one) { return one <= PhoneClass::kVowelWeak; }

PhoneTable PhoneTable::read_folder(const std::filesystem::path& folder) {
    PhoneTable table;
    table.read_phones(folder / "phones.tsv");
    table.read_marks(folder / "phone_marks.tsv");
    table.read_spellings(folder / "phone_spellings.tsv");
    return table;
}

PhoneTable PhoneTable::standard() { return read_folder(data_folder() / "rigs/standard"); }

void PhoneTable::read_phones(const std::filesystem::path& file) {
    std::vector<std::string> columns{"symbol", "kind", "place", "manner", "voiced", "viseme"};
    for (const std::string_view name : parameter_names()) columns.emplace_back(name);
    columns.emplace_back("class");
    for (const TableLine& line : read_table_lines(file, columns)) {
        PhoneEntry phone;
        phone.symbol = line.cells[0];
        if (phone.symbol.empty() || find(phone.symbol))
            throw Error(line.place, "a symbol that no other line has", in_quotes(phone.symbol));
        phone.place = line.cells[2];
        phone.manner = line.cells[3];
        phone.voiced = line.cells[4] == "+";
        phone.viseme = line.cells[5];
        for (std::size_t p = 0; p < kParameterCount; ++p) phone.target[p] = line.number(6 + p);
        phone.kind = static_cast<PhoneClass>(
            index_of_name(line.place, line.cells.back(), phone_class_names()));
        phones_.push_back(std::move(phone));
    }
    if (!find(kPause)) throw Error(file.string(), "a line for the pause, \"_\"", "none");
}

void PhoneTable::read_marks(const std::filesystem::path& file) {
    const std::vector<std::string> columns{
        "mark",          "name",           "jaw_mm",      "gap_mm",    "gap_factor", "width_mm",
        "protrusion_mm", "tip_forward_mm", "body_height", "body_back", "weight"};
    for (const TableLine& line : read_table_lines(file, columns)) {
        Mark mark;
        mark.mark = line.cells[0];
        if (mark.mark.empty()) throw Error(line.place, "a mark", "none");
        value_of(mark.add, Parameter::kJaw) = line.number(2);
        value_of(mark.add, Parameter::kGap) = line.number(3);
        mark.gap_factor = line.number(4);
        value_of(mark.add, Parameter::kWidth) = line.number(5);
        value_of(mark.add, Parameter::kProtrusion) = line.number(6);
        value_of(mark.add, Parameter::kTipForward) = line.number(7);
        value_of(mark.add, Parameter::kBodyHeight) = line.number(8);
        value_of(mark.add, Parameter::kBodyBack) = line.number(9);
        mark.weight = line.number(10);
        marks_.push_back(std::move(mark));
    }
}

void PhoneTable::read_spellings(const std::filesystem::path& file) {
    for (const TableLine& line : read_table_lines(file, {"set", "spelling", "ipa"})) {
        if (line.cells[1].empty()) throw Error(line.place, "a spelling", "none");
        const std::string& set = line.cells[0];
        if (std::find(sets_.begin(), sets_.end(), set) == sets_.end()) sets_.push_back(set);
        if (!spellings_[set].emplace(line.cells[1], line.cells[2]).second)
            throw Error(line.place, "a spelling that no other line of the set has",
                        in_quotes(line.cells[1]));
    }
    if (std::find(sets_.begin(), sets_.end(), "ipa") == sets_.end())
        throw Error(file.string(), "lines of the set \"ipa\"", "none");
}

const PhoneEntry* PhoneTable::find(std::string_view symbol) const {
    for (const PhoneEntry& phone : phones_)
        if (phone.symbol == symbol) return &phone;
    return nullptr;
}

const PhoneEntry* PhoneTable::longest_at(std::string_view text) const {
    const PhoneEntry* longest = nullptr;
    for (const PhoneEntry& phone : phones_)
        if (text.starts_with(phone.symbol) &&
            (!longest || phone.symbol.size() > longest->symbol.size()))
            longest = &phone;
    return longest;
}

const PhoneTable::Mark* PhoneTable::mark_at(std::string_view text) const {
    for (const Mark& mark : marks_)
        if (text.starts_with(mark.mark)) return &mark;
    return nullptr;
}

std::string PhoneTable::nearest(std::string_view symbol, const std::string& set) const {
    std::vector<std::string_view> known;
    if (set != "ipa")
        for (const auto& [spelling, ignored] : spellings_.at(set)) known.push_back(spelling);
    if (!is_whole_word_set(set))
        for (const PhoneEntry& phone : phones_) known.push_back(phone.symbol);
    std::string near = nearest_name(symbol, known);
    if (!near.empty() || is_whole_word_set(set)) return near;
    // A single character resembles none by its edit distance: the neighbour in Unicode, whose blocks keep similar letters together.
    const auto code = [](std::string_view text) {
        std::uint32_t value = 0;
        const std::size_t size = std::max<std::size_t>(1, character_size(text));
        for (std::size_t i = 0; i < size && i < text.size(); ++i) {
            const auto byte = static_cast<unsigned char>(text[i]);
            value = i == 0 ? byte & (size == 1 ? 0x7fu : 0xffu >> (size + 1))
                           : value << 6 | (byte & 0x3fu);
        }
        return value;
    };
    std::uint32_t best = ~0u;
    for (const PhoneEntry& phone : phones_) {
        if (phone.symbol == kPause) continue;
        const std::uint32_t a = code(symbol), b = code(phone.symbol), apart = a > b ? a - b : b - a;
        if (apart >= best) continue;
        best = apart;
        near = phone.symbol;
    }
    return near;
}

PhoneEntry PhoneTable::phone(const std::string& symbol, const std::string& place) const {
    std::string_view rest = symbol;
    const PhoneEntry* base = longest_at(rest);
    const auto refuse = [&](std::string_view what) {
        throw Error(place,
                    "a symbol of the IPA (the nearest is " + in_quotes(nearest(what, "ipa")) + ")",
                    in_quotes(shortened_text(symbol, 60)));
    };
    if (!base) refuse(rest);
    PhoneEntry out = *base;
    out.symbol = symbol;
    rest.remove_prefix(base->symbol.size());
    while (!rest.empty()) {
        const Mark* mark = mark_at(rest);
        if (!mark) refuse(rest);
        rest.remove_prefix(mark->mark.size());
        for (std::size_t p = 0; p < kParameterCount; ++p) {
            if (p == static_cast<std::size_t>(Parameter::kGap)) continue;
            out.target[p] += mark->add[p];
        }
        double& gap = value_of(out.target, Parameter::kGap);
        if (gap > 0)
            gap = std::max(0.0, gap * mark->gap_factor + value_of(mark->add, Parameter::kGap));
        out.weight *= mark->weight;
    }
    for (const Parameter p : {Parameter::kTipHeight, Parameter::kBodyHeight, Parameter::kBodyBack})
        value_of(out.target, p) = std::clamp(value_of(out.target, p), 0.0, 1.0);
    value_of(out.target, Parameter::kJaw) = std::max(0.0, value_of(out.target, Parameter::kJaw));
    return out;
}

std::string PhoneTable::in_ipa(const std::string& label, const std::string& set,
                               const std::string& place) const {
    const auto& own = spellings_.at(set);
    const auto& common = spellings_.at("ipa");
    std::string out;
    std::string_view rest = label;
    if (is_whole_word_set(set)) {
        for (const std::string& word : words_of(label)) {
            std::string symbol = word;
            std::string_view stress;
            // "AH0" is one symbol with a digit of stress.
            if (set == "arpabet" && symbol.back() >= '0' && symbol.back() <= '2') {
                stress = symbol.back() == '1' ? kPrimary : symbol.back() == '2' ? kSecondary : "";
                symbol.pop_back();
            }
            const auto found = own.find(symbol);
            if (found == own.end()) {
                const std::string near = nearest(symbol, set);
                throw Error(place,
                            "a symbol of the set " + in_quotes(set) +
                                (near.empty() ? "" : " (the nearest is " + in_quotes(near) + ")"),
                            in_quotes(shortened_text(word, 60)));
            }
            out += std::string(stress) + found->second;
        }
        return out;
    }
    while (!rest.empty()) {
        const std::pair<const std::string, std::string>* longest = nullptr;
        for (const auto* table : {&own, &common})
            for (const auto& entry : *table)
                if (rest.starts_with(entry.first) &&
                    (!longest || entry.first.size() > longest->first.size()))
                    longest = &entry;
        // A symbol of the IPA that is longer than the spelling is meant as it stands.
        const PhoneEntry* phone = longest_at(rest);
        if (longest && (!phone || longest->first.size() >= phone->symbol.size())) {
            out += longest->second;
            rest.remove_prefix(longest->first.size());
        } else {
            const std::size_t size =
                phone ? phone->symbol.size() : std::max<std::size_t>(1, character_size(rest));
            out += rest.substr(0, size);
            rest.remove_prefix(std::min(size, rest.size()));
        }
    }
    return out;
}

std::vector<SplitPhone> PhoneTable::split(const std::string& label, const std::string& set,
                                          const std::string& place) const {
    index_of_name(place, set, sets_);
    const std::string text = trimmed(label);
    if (kSilences.contains(text) && set != "azure") return {{std::string(kPause), 0, 0, 1}};
    const std::string ipa = in_ipa(text, set, place);
    if (ipa == kPause) return {{std::string(kPause), 0, 0, 1}};
    std::vector<SplitPhone> parts;
    std::vector<bool> tied;  // to the part before
    int stress = 0;
    bool tie = false;
    for (std::string_view rest = ipa; !rest.empty();) {
        if (take(rest, " ") || take(rest, "|") || take(rest, "‿")) continue;
        if (take(rest, kPrimary)) {
            stress = 2;
            continue;
        }
        if (take(rest, kSecondary)) {
            stress = std::max(stress, 1);
            continue;
        }
        if (std::any_of(std::begin(kTies), std::end(kTies),
                        [&](std::string_view one) { return take(rest, one); })) {
            tie = !parts.empty();
            continue;
        }
        if (std::any_of(std::begin(kTones), std::end(kTones),
                        [&](std::string_view one) { return take(rest, one); }) ||
            (!parts.empty() && rest[0] >= '0' && rest[0] <= '9' && take(rest, rest.substr(0, 1))))
            continue;
        if (!parts.empty() && take(rest, kLong)) {
            parts.back().length_mark = 2;
            continue;
        }
        if (!parts.empty() && take(rest, kHalfLong)) {
            parts.back().length_mark = 1;
            continue;
        }
        if (const Mark* mark = parts.empty() ? nullptr : mark_at(rest)) {
            parts.back().symbol += mark->mark;
            rest.remove_prefix(mark->mark.size());
            continue;
        }
        const PhoneEntry* phone = longest_at(rest);
        if (!phone || phone->symbol == kPause)
            throw Error(
                place,
                "a symbol of the set " + in_quotes(set) + " (the nearest is " +
                    in_quotes(nearest(
                        rest.substr(0, std::max<std::size_t>(1, character_size(rest))), set)) +
                    ")",
                in_quotes(shortened_text(text, 60)));
        parts.push_back({phone->symbol, 0, stress, 1});
        tied.push_back(tie);
        stress = 0;
        tie = false;
        rest.remove_prefix(phone->symbol.size());
    }
    if (parts.empty()) return {{std::string(kPause), 0, 0, 1}};
    double sum = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto kind = [&](std::size_t k) { return longest_at(parts[k].symbol); };
        if (parts[i].length_mark == 2) parts[i].share = kLongRatio;
        if (i == 0) continue;
        const PhoneEntry *one = kind(i - 1), *two = kind(i);
        double first = 0.5;
        if (is_vowel(one->kind) && is_vowel(two->kind)) first = kDiphthongFirst;
        if (one->is_stop() && (two->manner == "fric" || tied[i])) first = kAffricateClosure;
        if (first == 0.5 || parts[i].length_mark || parts[i - 1].length_mark) continue;
        parts[i - 1].share = 2 * first;
        parts[i].share = 2 * (1 - first);
    }
    for (const SplitPhone& part : parts) sum += part.share;
    for (SplitPhone& part : parts) part.share /= sum;
    return parts;
}

}  // namespace risorius::speech
