// SPDX-License-Identifier: MIT
/// \file
/// A second of invented motion, and files of it as face trackers write them.
#pragma once

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "risorius/track/arkit_names.h"

namespace risorius::motion {

/// What happens at a time.
struct Moment {
    double smile_left, smile_right, jaw_open, brow;
    double yaw_deg, pitch_deg, roll_deg, gaze_deg;
};

/// A bump between two times.
inline double bump(double t_s, double from_s, double to_s) {
    const double s = (t_s - from_s) / (to_s - from_s);
    return s <= 0 || s >= 1 ? 0 : std::pow(std::sin(3.14159265358979323846 * s), 2);
}

inline Moment moment(double t_s) {
    return {0.8 * bump(t_s, 0.1, 0.7), 0.3 * bump(t_s, 0.1, 0.7), 0.5 * bump(t_s, 0.4, 0.9),
            0.6 * bump(t_s, 0.5, 0.9), 12 * bump(t_s, 0, 1),      -6 * bump(t_s, 0.2, 1),
            4 * bump(t_s, 0.1, 1),     10 * bump(t_s, 0.25, 0.45)};
}

inline double weight(const std::string& shape, double t_s) {
    const Moment now = moment(t_s);
    return shape == "mouthSmileLeft"    ? now.smile_left
           : shape == "mouthSmileRight" ? now.smile_right
           : shape == "jawOpen"         ? now.jaw_open
           : shape == "browInnerUp"     ? now.brow
           : shape == "eyeLookOutLeft"  ? now.gaze_deg / 35
                                        : 0;
}

inline std::string number_text(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

constexpr double kRad = 3.14159265358979323846 / 180;

/// Frames are left out where `lost` says so. `codes`: the timecode of each frame.
template <class Code, class Lost>
std::string live_link_sample(int frames, double fps, const Code& code, const Lost& lost) {
    std::string out = "Timecode,BlendshapeCount";
    for (std::string name : track::arkit_names()) {
        name[0] = static_cast<char>(name[0] - 'a' + 'A');
        out += "," + name;
    }
    out +=
        ",HeadYaw,HeadPitch,HeadRoll,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,"
        "RightEyePitch,RightEyeRoll\n";
    for (int f = 0; f < frames; ++f) {
        if (lost(f)) continue;
        const double t_s = f / fps;
        out += code(f) + ",61";
        for (const std::string& name : track::arkit_names())
            out += "," + number_text(weight(name, t_s), 8);
        const Moment now = moment(t_s);
        for (const double deg : {now.yaw_deg, now.pitch_deg, now.roll_deg, now.gaze_deg, 0.0, 0.0,
                                 now.gaze_deg, 0.0, 0.0})
            out += "," + number_text(kRad * deg, 8);
        out += "\n";
    }
    return out;
}

/// The head's rotation by columns, as row-major numbers of the transposed matrix.
inline std::array<double, 9> head_columns(const Moment& now) {
    const double y = kRad * now.yaw_deg, x = -kRad * now.pitch_deg, z = -kRad * now.roll_deg;
    const double cy = std::cos(y), sy = std::sin(y), cx = std::cos(x), sx = std::sin(x),
                 cz = std::cos(z), sz = std::sin(z);
    return {cy * cz + sy * sx * sz,
            cx * sz,
            -sy * cz + cy * sx * sz,
            -cy * sz + sy * sx * cz,
            cx * cz,
            sy * sz + cy * sx * cz,
            sy * cx,
            -sx,
            cy * cx};
}

/// Frame 15 has no face.
inline std::string mediapipe_sample() {
    std::string out;
    for (int f = 0; f <= 30; ++f) {
        const double t_s = f / 30.0;
        out += "{\"timestampMs\":" + number_text(1e3 * t_s, 3) + ",\"faceBlendshapes\":[";
        const std::array<double, 9> c = head_columns(moment(t_s));
        std::string matrix;
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 4; ++i)
                matrix += (i < 3 ? number_text(c[static_cast<std::size_t>(3 * k + i)], 8) : "0") +
                          std::string(",");
        if (f != 15) {
            out += "{\"categories\":[{\"score\":0.9,\"categoryName\":\"_neutral\"}";
            for (const std::string& name : track::arkit_names())
                if (name != "tongueOut")
                    out += ",{\"score\":" + number_text(weight(name, t_s), 6) +
                           ",\"categoryName\":\"" + name + "\"}";
            out += "]}";
        }
        out += "],\"facialTransformationMatrixes\":[" +
               (f == 15 ? std::string() : "{\"data\":[" + matrix + "0,0,-45,1]}") + "]}\n";
    }
    return out;
}

inline std::string arkit_sample() {
    std::string out = "{\"fps\":30,\"frames\":[";
    for (int f = 0; f <= 30; ++f) {
        const double t_s = f / 30.0;
        out += (f > 0 ? ",{\"t\":" : "{\"t\":") + number_text(t_s, 6) + ",\"blendShapes\":{";
        bool first = true;
        for (const std::string& name : track::arkit_names())
            if (weight(name, t_s) > 0) {
                out += (first ? "\"" : ",\"") + name + "\":" + number_text(weight(name, t_s), 5);
                first = false;
            }
        out += "},\"transform\":null}";
    }
    return out + "]}";
}

/// Rows 15 and 16 failed; their numbers are nonsense.
inline std::string openface_sample() {
    std::string out =
        "frame, face_id, timestamp, confidence, success, gaze_angle_x, gaze_angle_y, pose_Rx, "
        "pose_Ry, pose_Rz, AU01_r, AU12_r, AU26_r, AU12_c, AU26_c, AU28_c\n";
    for (int f = 0; f <= 30; ++f) {
        const double t_s = f / 30.0;
        const Moment now = moment(t_s);
        const bool failed = f == 15 || f == 16;
        out += std::to_string(f + 1) + ", 0, " + number_text(t_s, 3) + ", 0.98, " +
               (failed ? "0" : "1");
        for (const double rad : {kRad * (now.gaze_deg + now.yaw_deg), -kRad * now.pitch_deg,
                                 -kRad * now.pitch_deg, -kRad * now.yaw_deg, kRad * now.roll_deg})
            out += ", " + number_text(failed ? 9 : rad, 3);
        for (const double unit : {now.brow, now.smile_left, now.jaw_open})
            out += ", " + number_text(failed ? 5 : 5 * unit, 2);
        // The jaw is said not to move, whatever its intensity; lips are sucked at the end.
        out += std::string(", 1, 0, ") + (f > 25 ? "1" : "0") + "\n";
    }
    return out;
}

/// Row 3 has no face.
inline std::string pyfeat_sample() {
    std::string out = "FaceRectX,FaceScore,Pitch,Roll,Yaw,AU01,AU12,AU28,happiness,input,frame\n";
    for (int i = 0; i <= 10; ++i) {
        const Moment now = moment(i / 10.0);
        if (i == 3)
            out += ",,,,,,,,,clip.mp4," + std::to_string(3 * i) + "\n";
        else
            out += "10,0.99," + number_text(now.pitch_deg, 3) + "," + number_text(now.roll_deg, 3) +
                   "," + number_text(now.yaw_deg, 3) + "," + number_text(now.brow, 4) + "," +
                   number_text(now.smile_left, 4) + ",0,0.5,clip.mp4," + std::to_string(3 * i) +
                   "\n";
    }
    return out;
}

inline std::string osc_text(const std::string& text) {
    return text + std::string(4 - text.size() % 4, '\0');
}
inline std::string osc_number(double value) {
    const auto number = static_cast<float>(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, 4);
    std::string out;
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(bits >> shift & 0xff);
    return out;
}

/// Values that no Apply follows come last. One packet is a bundle.
inline std::string vmc_sample() {
    std::string out;
    const auto line = [&](double t_s, const std::string& bytes) {
        out += number_text(t_s, 3) + " ";
        for (const char c : bytes) {
            char text[8];
            std::snprintf(text, sizeof text, "%02x", static_cast<unsigned>(c) & 0xff);
            out += text;
        }
        out += "\n";
    };
    const auto value = [](const std::string& name, double weight) {
        return osc_text("/VMC/Ext/Blend/Val") + osc_text(",sf") + osc_text(name) +
               osc_number(weight);
    };
    for (int i = 0; i <= 10; ++i) {
        const double t_s = 0.1 * i;
        const Moment now = moment(t_s);
        // Unity's x is to the subject's right: turns about y and z change their sense.
        const double y = -kRad * now.yaw_deg / 2;
        line(t_s, osc_text("/VMC/Ext/T") + osc_text(",f") + osc_number(t_s));
        line(t_s, osc_text("/VMC/Ext/Bone/Pos") + osc_text(",sfffffff") + osc_text("Head") +
                      osc_number(0) + osc_number(1) + osc_number(0) + osc_number(0) +
                      osc_number(std::sin(y)) + osc_number(0) + osc_number(std::cos(y)));
        line(t_s, value("mouthSmileLeft", now.smile_left));
        const std::string part = value("Blink_L", now.brow);
        line(t_s, osc_text("#bundle") + std::string(8, '\0') +
                      std::string{'\0', '\0', '\0', static_cast<char>(part.size())} + part);
        line(t_s, value("Joy", 1));
        line(t_s, osc_text("/VMC/Ext/Blend/Apply") + osc_text(","));
    }
    line(1.2, value("mouthSmileLeft", 1));
    return out;
}

/// The neck turns, the head nods and tilts; each has an order of its own.
inline std::string bvh_sample() {
    std::string out =
        "HIERARCHY\nROOT Neck\n{\n\tOFFSET 0 0 0\n\tCHANNELS 6 Xposition Yposition Zposition "
        "Zrotation Xrotation Yrotation\n\tJOINT Head\n\t{\n\t\tOFFSET 0 10 2\n\t\tCHANNELS 3 "
        "Xrotation Zrotation Yrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 18 0\n\t\t}\n\t}\n}\n"
        "MOTION\nFrames: 31\nFrame Time: 0.0333333\n";
    for (int f = 0; f <= 30; ++f) {
        const Moment now = moment(f / 30.0);
        out += "1 2 3 0 0 " + number_text(now.yaw_deg, 5) + " " + number_text(-now.pitch_deg, 5) +
               " " + number_text(-now.roll_deg, 5) + " 0\n";
    }
    return out;
}

}  // namespace risorius::motion
