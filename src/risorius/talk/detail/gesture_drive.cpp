// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/gesture_drive.h"

#include "risorius/speech/gaze.h"

namespace risorius::talk {

namespace {

class GestureDrive : public track::DriveSource {
  public:
    GestureDrive(std::vector<speech::Gesture> gestures, std::vector<speech::GazeShift> gaze,
                 track::Expansion brows, double start_s)
        : gestures_(std::move(gestures)),
          gaze_(std::move(gaze)),
          brows_(std::move(brows)),
          start_s_(start_s) {}

    void add(double t_s, track::Expansion& sum) const override {
        using track::Kinematic;
        double nod_deg = 0;
        for (const speech::Gesture& gesture : gestures_) {
            const double value = gesture.at(t_s - start_s_);
            if (value == 0) continue;
            if (gesture.kind == speech::Gesture::Kind::kBrow)
                sum.add(brows_, value);
            else
                nod_deg += value;
        }
        const auto turn = [&](Kinematic channel, double degrees) {
            sum.kinematic[static_cast<std::size_t>(channel)] += degrees;
        };
        turn(Kinematic::kHeadPitch, -nod_deg);
        if (gaze_.empty()) return;
        // The eyes stay on what they see while the head nods.
        const Vec2 look = speech::gaze_at(gaze_, t_s - start_s_) + Vec2(0, nod_deg);
        for (const Kinematic yaw : {Kinematic::kGazeYawLeft, Kinematic::kGazeYawRight})
            turn(yaw, look.x());
        for (const Kinematic pitch : {Kinematic::kGazePitchLeft, Kinematic::kGazePitchRight})
            turn(pitch, look.y());
    }

  private:
    std::vector<speech::Gesture> gestures_;
    std::vector<speech::GazeShift> gaze_;
    track::Expansion brows_;
    double start_s_;
};

}  // namespace

std::shared_ptr<const track::DriveSource> gesture_drive(const speech::Prosody& prosody,
                                                        const rig::RigDescription& rig,
                                                        double start_s) {
    if (prosody.gestures.empty() && prosody.gaze.empty()) return nullptr;
    const track::ChannelTable channels = rig.channels();
    track::Expansion brows = track::Expansion::none(channels);
    for (const char* unit : {"AU1", "AU2"})
        if (const track::ActionUnit* found = rig.facs.find(unit))
            brows.add(track::expand(*found, std::nullopt, channels), 1);
    return std::make_shared<GestureDrive>(prosody.gestures, prosody.gaze, std::move(brows),
                                          start_s);
}

std::vector<track::BlinkEvent> blinks_of(const speech::Prosody& prosody,
                                         const rig::RigDescription& rig, double start_s) {
    std::vector<track::BlinkEvent> out;
    const track::ActionUnit* unit = rig.facs.find("AU45");
    if (!unit) return out;
    const track::ChannelTable channels = rig.channels();
    for (const double blink_s : prosody.blinks_s) {
        track::BlinkEvent event;
        event.start_s = start_s + blink_s;
        event.drives = track::expand(*unit, std::nullopt, channels);
        out.push_back(std::move(event));
    }
    return out;
}

}  // namespace risorius::talk
