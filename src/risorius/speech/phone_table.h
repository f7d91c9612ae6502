// SPDX-License-Identifier: MIT
/// \file
/// The sounds of speech (phones) and what jaw, lips and tongue do in each. The tables are rigs/standard/phones.tsv,
/// phone_marks.tsv and phone_spellings.tsv; symbols are those of the International Phonetic Alphabet (IPA).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace risorius::speech {

/// What a curve describes. Distances are in mm from the face at rest.
enum class Parameter {
    kJaw,         ///< opening at the incisors
    kGap,         ///< free height between the lips in the middle; below 0 they press
    kWidth,       ///< change of the width of the mouth
    kProtrusion,  ///< of both lips
    kTipHeight,   ///< tongue tip, [0, 1]; 1: on the ridge behind the upper teeth
    kTipForward,  ///< tongue tip, mm
    kBodyHeight,  ///< tongue body, [0, 1]; 1: a close vowel
    kBodyBack,    ///< tongue body, [0, 1]; 1: at the soft palate
    kCount
};
inline constexpr std::size_t kParameterCount = static_cast<std::size_t>(Parameter::kCount);
/// Names of the columns of the table of phones, in the order of Parameter.
const std::array<std::string_view, kParameterCount>& parameter_names();

using Articulation = std::array<double, kParameterCount>;
inline double& value_of(Articulation& a, Parameter p) { return a[static_cast<std::size_t>(p)]; }
inline double value_of(const Articulation& a, Parameter p) {
    return a[static_cast<std::size_t>(p)];
}

/// Phones of a class have the same windows, time constants and bounds; see windows.h.
enum class PhoneClass {
    kVowel,
    kVowelSpread,
    kVowelRound,
    kVowelWeak,
    kClosure,          ///< lips touch: p b m
    kLabiodental,      ///< lower lip at the upper incisors: f v
    kLabiodentalSoft,  ///< near them: Finnish v
    kSibilant,         ///< teeth nearly closed: s z
    kSibilantRound,    ///< and lips pushed out: sh
    kRoundConsonant,   ///< w, English r
    kTongue,           ///< k g r: the lips are those of the neighbours
    kTongueTip,        ///< t d n l th: so are they, but the jaw rises
    kGlide,            ///< j: as a short i
    kNeutral,          ///< h, glottal stop: the shape of what follows
    kSilence
};
/// Names in the table, in the order of PhoneClass.
const std::vector<std::string>& phone_class_names();
bool is_vowel(PhoneClass one);

/// A phone of the table, or one of it with marks.
struct PhoneEntry {
    std::string symbol;
    PhoneClass kind = PhoneClass::kSilence;
    std::string place, manner;
    bool voiced = false;
    std::string viseme;
    Articulation target{};
    double weight = 1;  ///< how much the target counts, relative to others of the class
    bool is_stop() const { return manner == "stop"; }
    /// Whether the body of the tongue closes the mouth at the palate: k g ng and the like.
    bool closes_palate() const {
        return (place == "palatal" || place == "velar" || place == "uvular") &&
               (is_stop() || manner == "nasal");
    }
    /// Whether the tip of the tongue touches the ridge behind the upper teeth: t d n l.
    bool closes_ridge() const { return value_of(target, Parameter::kTipHeight) >= 1; }
};

/// The symbol of a pause.
inline constexpr std::string_view kPause = "_";

/// One phone of a label, see PhoneTable::split().
struct SplitPhone {
    std::string symbol;   ///< with its marks, without length and stress
    int length_mark = 0;  ///< 0 short, 1 half long, 2 long
    int stress = 0;       ///< 0 none, 1 secondary, 2 primary
    double share = 1;     ///< of the time of the label; shares of a label add up to 1
};

/// All tables of phones.
class PhoneTable {
  public:
    /// Reads the three tables of a folder. Throws Error that names file and line.
    static PhoneTable read_folder(const std::filesystem::path& folder);
    /// The tables of the toolkit, rigs/standard of data_folder().
    static PhoneTable standard();

    /// The phone of a symbol with its marks. Throws Error with `place` for an unknown symbol; the message names the nearest one.
    PhoneEntry phone(const std::string& symbol, const std::string& place) const;

    /// Splits a label into its phones. `set` is one of sets(). Two vowels of one label are a diphthong, of which the first takes
    /// 55 % of the time; the closure of an affricate takes 45 %. An empty label, and the words for silence that aligners write
    /// ("sil", "sp", "pau", "<eps>", "#"), give one pause. Throws Error with `place`, and the nearest symbol, for an unknown one.
    std::vector<SplitPhone> split(const std::string& label, const std::string& set,
                                  const std::string& place) const;

    /// Names of the sets of symbols: "ipa", "espeak", "arpabet", "xsampa", "finnish".
    const std::vector<std::string>& sets() const { return sets_; }
    const std::vector<PhoneEntry>& phones() const { return phones_; }

  private:
    struct Mark {
        std::string mark;
        Articulation add{};
        double gap_factor = 1, weight = 1;
    };
    void read_phones(const std::filesystem::path& file);
    void read_marks(const std::filesystem::path& file);
    void read_spellings(const std::filesystem::path& file);
    const PhoneEntry* find(std::string_view symbol) const;
    /// The longest phone at the start of a text; null when none begins there.
    const PhoneEntry* longest_at(std::string_view text) const;
    const Mark* mark_at(std::string_view text) const;
    /// Replaces the spellings of a set by IPA.
    std::string in_ipa(const std::string& label, const std::string& set,
                       const std::string& place) const;
    std::string nearest(std::string_view symbol, const std::string& set) const;

    std::vector<PhoneEntry> phones_;
    std::vector<Mark> marks_;
    std::vector<std::string> sets_;
    /// Of each set: from spelling to IPA
    std::map<std::string, std::map<std::string, std::string>> spellings_;
};

}  // namespace risorius::speech
