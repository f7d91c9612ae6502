// SPDX-License-Identifier: MIT
// The VMC protocol: OSC packets, one a line as "seconds hexadecimal". Nothing counts before /VMC/Ext/Blend/Apply.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/text_lines.h"
#include "risorius/motion/detail/motion_readers.h"

namespace risorius::motion::detail {

namespace {

/// A message of Open Sound Control 1.0.
struct OscMessage {
    std::string address;
    std::vector<std::string> texts;
    std::vector<double> numbers;
};

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// Takes a text that is padded with zeros to a multiple of four bytes.
std::string take_text(std::string_view& bytes, const std::string& place) {
    const std::size_t length = bytes.find('\0');
    if (length == std::string_view::npos || (length / 4 + 1) * 4 > bytes.size())
        throw Error(place, "a text that ends within its packet", "one that does not");
    std::string out(bytes.substr(0, length));
    bytes.remove_prefix((length / 4 + 1) * 4);
    return out;
}

void read_packet(std::string_view bytes, const std::string& place, int depth,
                 std::vector<OscMessage>& out) {
    constexpr int kDeepest = 8;
    if (depth > kDeepest) throw Error(place, "at most 8 bundles in one another", "more");
    const std::string address = take_text(bytes, place);
    if (address == "#bundle") {
        if (bytes.size() < 8) throw Error(place, "the time of a bundle", "none");
        bytes.remove_prefix(8);
        while (!bytes.empty()) {
            if (bytes.size() < 4 || big_endian(bytes) > bytes.size() - 4)
                throw Error(place, "parts within their bundle", "a longer one");
            const std::size_t size = big_endian(bytes);
            read_packet(bytes.substr(4, size), place, depth + 1, out);
            bytes.remove_prefix(4 + size);
        }
        return;
    }
    OscMessage message{address, {}, {}};
    const std::string types = bytes.empty() ? "," : take_text(bytes, place);
    if (!types.starts_with(','))
        throw Error(place, "types that begin with a comma", in_quotes(types));
    for (const char type : std::string_view(types).substr(1)) {
        if (type == 's') {
            message.texts.push_back(take_text(bytes, place));
        } else if (type == 'f' || type == 'i') {
            if (bytes.size() < 4) throw Error(place, "a number of four bytes", "fewer");
            const std::uint32_t bits = big_endian(bytes);
            float value = 0;
            std::memcpy(&value, &bits, sizeof value);
            const double number = type == 'f'
                                      ? static_cast<double>(value)
                                      : static_cast<double>(static_cast<std::int32_t>(bits));
            if (!std::isfinite(number)) throw Error(place, "finite numbers", "others");
            message.numbers.push_back(number);
            bytes.remove_prefix(4);
        } else {
            return;  // types that no message of the protocol has
        }
    }
    out.push_back(std::move(message));
}

std::string bytes_of_hex(std::string_view hex, const std::string& place) {
    std::string out;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        unsigned value = 0;
        const auto [end, problem] = std::from_chars(hex.data() + i, hex.data() + i + 2, value, 16);
        if (problem != std::errc() || end != hex.data() + i + 2)
            throw Error(place, "hexadecimal digits", in_quotes(std::string(hex.substr(i, 2))));
        out += static_cast<char>(value);
    }
    if (hex.size() % 2 != 0) throw Error(place, "two digits for each byte", "an odd number");
    return out;
}

/// Rotations in Unity's left-handed frame: its x is to the subject's right.
Mat3 turn_of_bone(const std::vector<double>& numbers) {
    const Eigen::Quaterniond q(numbers[6], numbers[3], -numbers[4], -numbers[5]);
    return q.norm() > 0 ? Mat3(q.normalized().toRotationMatrix()) : Mat3(Mat3::Identity());
}

/// The shapes that a sender's name stands for; none for other names.
std::vector<std::string> shapes_of(const std::string& name) {
    if (const std::string shape = arkit_spelling(name); !shape.empty()) return {shape};
    if (name == "Blink" || name == "blink") return {"eyeBlinkLeft", "eyeBlinkRight"};
    if (name == "Blink_L" || name == "blinkLeft") return {"eyeBlinkLeft"};
    if (name == "Blink_R" || name == "blinkRight") return {"eyeBlinkRight"};
    return {};
}

/// What has been sent since the last sample.
class Sent {
  public:
    void take(const OscMessage& message) {
        if (message.address == "/VMC/Ext/T" && !message.numbers.empty())
            time_s_ = message.numbers[0];
        else if (message.address == "/VMC/Ext/Blend/Val" && !message.texts.empty() &&
                 !message.numbers.empty())
            waiting_[message.texts[0]] = message.numbers[0];
        else if (message.address == "/VMC/Ext/Bone/Pos" && !message.texts.empty() &&
                 message.numbers.size() >= 7 &&
                 (message.texts[0] == "Head" || message.texts[0] == "Neck"))
            (message.texts[0] == "Head" ? head_ : neck_) = turn_of_bone(message.numbers);
    }
    /// Adds a sample of all values up to now.
    void apply(double line_s, MotionBuilder& out) {
        for (const auto& [name, value] : waiting_) {
            const std::vector<std::string> shapes = shapes_of(name);
            if (shapes.empty()) out.unmapped(name);
            for (const std::string& shape : shapes) values_[shape] = value;
        }
        waiting_.clear();
        const double t_s = time_s_.value_or(line_s);
        // Senders may apply twice in one moment.
        if (out.size() > 0 && t_s == out.motion().times_s.back()) return;
        out.begin(t_s, true);
        for (const auto& [shape, value] : values_) out.set(shape, value);
        if (head_ || neck_)
            out.set_head(
                head_angles(neck_.value_or(Mat3::Identity()) * head_.value_or(Mat3::Identity())));
    }

  private:
    std::optional<double> time_s_;
    std::map<std::string, double> waiting_;  ///< by the sender's names
    std::map<std::string, double> values_;   ///< of shapes
    std::optional<Mat3> head_, neck_;
};

}  // namespace

RecordedMotion read_vmc(const std::filesystem::path& file) {
    const std::string text = read_text(file, kMotionFile);
    MotionBuilder out;
    Sent sent;
    for (TextLines lines(text); lines.next();) {
        const std::string_view line = lines.line();
        if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
        const std::string place = file.string() + ": line " + std::to_string(lines.number());
        double time_s = 0;
        const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), time_s);
        std::string_view rest = line.substr(static_cast<std::size_t>(end - line.data()));
        if (problem != std::errc() || !std::isfinite(time_s) || rest.empty() || rest.front() != ' ')
            throw Error(place, "a time in seconds and bytes in hexadecimal", "others");
        while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
        while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
        std::vector<OscMessage> messages;
        read_packet(bytes_of_hex(rest, place), place, 0, messages);
        for (const OscMessage& message : messages)
            if (message.address == "/VMC/Ext/Blend/Apply")
                sent.apply(time_s, out);
            else
                sent.take(message);
    }
    return out.finish(file.string(), "vmc", 0);
}

}  // namespace risorius::motion::detail
