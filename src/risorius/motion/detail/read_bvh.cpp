// SPDX-License-Identifier: MIT
// Biovision BVH: of the joints, neck and head are read. The order of the channels is the order of the rotations.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/text_lines.h"
#include "risorius/motion/detail/motion_readers.h"

namespace risorius::motion::detail {

namespace {

/// Words of the text, with their lines.
class Words {
  public:
    Words(std::string_view text, std::string file) : lines_(text), file_(std::move(file)) {}
    bool next() {
        for (;;) {
            const std::size_t begin = rest_.find_first_not_of(" \t");
            if (begin != std::string_view::npos) {
                const std::size_t end = std::min(rest_.find_first_of(" \t", begin), rest_.size());
                word_ = rest_.substr(begin, end - begin);
                rest_.remove_prefix(end);
                return true;
            }
            if (!lines_.next()) return false;
            rest_ = lines_.line();
        }
    }
    std::string take(const std::string& what) {
        if (!next()) throw Error(file_, what, "the end of the file");
        return std::string(word_);
    }
    double number(const std::string& what) {
        const std::string word = take(what);
        double value = 0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
            throw Error(place(), what, in_quotes(word));
        return value;
    }
    void expect(const std::string& word) {
        if (const std::string found = take(in_quotes(word)); found != word)
            throw Error(place(), in_quotes(word), in_quotes(found));
    }
    std::string place() const { return file_ + ": line " + std::to_string(lines_.number()); }

  private:
    TextLines lines_;
    std::string file_;
    std::string_view rest_, word_;
};

struct Joint {
    std::string name;
    std::size_t first = 0;              ///< index of its first channel in a frame
    std::vector<std::string> channels;  ///< "Xposition", "Zrotation", ...
};

}  // namespace

RecordedMotion read_bvh(const std::filesystem::path& file) {
    const std::string text = read_text(file, kMotionFile);
    Words words(text, file.string());
    words.expect("HIERARCHY");
    std::vector<Joint> joints;
    std::size_t count = 0;
    for (std::string word = words.take("\"MOTION\""); word != "MOTION";
         word = words.take("\"MOTION\"")) {
        if (word == "ROOT" || word == "JOINT") {
            joints.push_back({words.take("the name of a joint"), count, {}});
        } else if (word == "CHANNELS") {
            const double channels = words.number("the number of channels");
            if (joints.empty() || !(channels >= 0 && channels <= 9))
                throw Error(words.place(), "0 to 9 channels of a joint", format_number(channels));
            if (!joints.back().channels.empty())
                throw Error(words.place(), "the channels of a joint once", "twice");
            joints.back().first = count;
            for (int i = 0; i < static_cast<int>(channels); ++i) {
                const std::string name = words.take("the name of a channel");
                if (name.size() < 9 || std::string("XYZ").find(name[0]) == std::string::npos)
                    throw Error(words.place(), "a channel such as Zrotation", in_quotes(name));
                joints.back().channels.push_back(name);
                ++count;
            }
        }
    }
    words.expect("Frames:");
    const double frames = words.number("the number of frames");
    words.expect("Frame");
    words.expect("Time:");
    const double step_s = words.number("the time of a frame, s");
    if (!(frames >= 1 && frames < 1e8) || !(step_s > 0))
        throw Error(words.place(), "at least one frame, and a time above 0", "others");
    std::vector<const Joint*> bent;
    MotionBuilder out;
    for (const Joint& joint : joints) {
        const std::string name = lower_case(joint.name);
        if (name.find("head") != std::string::npos || name.find("neck") != std::string::npos)
            bent.push_back(&joint);
        else
            out.unmapped(joint.name);
    }
    if (std::none_of(bent.begin(), bent.end(), [](const Joint* joint) {
            return lower_case(joint->name).find("head") != std::string::npos;
        }))
        throw Error(file.string(), "a joint with \"head\" in its name", "none");
    std::vector<double> values(count);
    for (long frame = 0; frame < static_cast<long>(frames); ++frame) {
        for (double& value : values) value = words.number("a number for each channel and frame");
        Mat3 turn = Mat3::Identity();
        for (const Joint* joint : bent)
            for (std::size_t c = 0; c < joint->channels.size(); ++c) {
                const std::string& name = joint->channels[c];
                if (!name.ends_with("rotation")) continue;
                turn = turn * Eigen::AngleAxisd(values[joint->first + c] / kDegree,
                                                Vec3(Vec3::Unit(name[0] - 'X')));
            }
        out.begin(static_cast<double>(frame) * step_s, true);
        out.set_head(head_angles(turn));
    }
    return out.finish(file.string(), "bvh", 1 / step_s);
}

}  // namespace risorius::motion::detail
