// SPDX-License-Identifier: MIT
/// \file
/// A script that is played, edited and pulled: everything that a page of the studio asks for, without sockets, threads and files.
///
/// Messages are JSON texts. They take effect between two ticks; a tick is a step of 1/60 s. The same messages between the same ticks
/// give the same poses, so that a session can be replayed from its log.
///
/// Moments of the script have been computed from its start, as `render` computes them, and are kept (detail/take.h). After an edit the face
/// goes on from a state that it had before the edit (detail/moments.h). Overrides and the pulls
/// of a hand are not part of the script: while there are any, the face goes on from where it is. What they do while recording is on and the
/// script plays becomes keys and "pulls" when it stops, as one step of undo.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/face/face.h"
#include "risorius/render/scene.h"
#include "risorius/scene/rig_files.h"
#include "risorius/track/script.h"
#include "risorius/track/timeline.h"
#include "risorius/view/detail/channel_recorder.h"
#include "risorius/view/detail/moments.h"
#include "risorius/view/detail/take.h"
#include "risorius/view/document.h"
#include "risorius/view/pose_frame.h"
#include "risorius/view/scene_frame.h"

namespace risorius::view {

/// What a session is made of.
struct SessionInputs {
    std::shared_ptr<const scene::RigFiles> rig;
    JsonCursor script;
    std::string quality = "preview";  ///< a name of face::quality_named()
    /// Reads a script with everything that it refers to. Throws Error.
    std::function<track::ScriptDescription(const JsonCursor& script)> read;
};

class Session {
  public:
    /// Builds the face, which takes a second. Throws Error.
    explicit Session(SessionInputs inputs);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// {"type": "welcome", "rig": ..., "channels": [...], "expressions": [...], "columns": [...]}
    std::string welcome() const;
    /// {"type": "document", "script": {...}, "revision": 3, "curves": {...}, ...}
    std::string document() const;
    std::string scene() const;    ///< see scene_frame.h
    std::string muscles() const;  ///< see scene_frame.h
    /// What the bones are estimated from, which takes seconds: a caller may do so on another thread (face/view/skull.h).
    const rig::Head& head() const { return face_->head(); }
    const rig::RigDescription& rig() const { return inputs_.rig->rig; }
    const render::Scene& drawn_scene() const { return scene_; }

    /// Does what a message asks, and returns messages for the page. What cannot be done gives a message "error"; nothing is thrown
    /// for wrong messages. The messages are listed in docs/howto/studio.md.
    std::vector<std::string> receive(const std::string& message);

    /// Makes a step if anything moves, and returns whether there is a new pose.
    bool tick();
    /// Messages that steps have caused, such as the end of the script.
    std::vector<std::string> events() { return std::exchange(events_, {}); }
    /// The last pose (pose_frame.h), and what a person may want to know about it as JSON. What nobody sees is not computed.
    std::string pose();
    std::string state() const;

    /// The text of the script's file. `saved` says that it has been written.
    std::string script_text() const { return document_.text(); }
    void saved() { document_.saved(); }
    bool dirty() const { return document_.dirty(); }

    /// [{"tick": 12, "message": {...}}]: what has been received.
    Json log() const;
    long ticks() const { return ticks_; }
    double unit_m() const { return unit_m_; }

  private:
    struct HandPull {
        track::Pull pull;
        bool recorded = false;
        double begin_s = 0;
        std::vector<track::PullKey> keys;
    };
    using Handler = void (Session::*)(const JsonCursor&);
    static const std::map<std::string, Handler>& handlers();

    // What messages do
    void edit(const JsonCursor& message);
    void undo(const JsonCursor& message);
    void redo(const JsonCursor& message);
    void override_channel(const JsonCursor& message);
    void release(const JsonCursor& message);
    void key(const JsonCursor& message);
    void play(const JsonCursor& message);
    void pause(const JsonCursor& message);
    void seek(const JsonCursor& message);
    void pull(const JsonCursor& message);
    void pull_to(const JsonCursor& message);
    void pull_end(const JsonCursor& message);
    void sights(const JsonCursor& message);
    void select(const JsonCursor& message);
    void record(const JsonCursor& message);
    void perform(const JsonCursor& message);

    static std::string error_message(const Json& id, const std::string& text);
    track::ScriptDescription read(const Json& script) const;
    void edit_document(const std::vector<Operation>& operations, const std::string& gesture);
    void use(track::ScriptDescription script);
    void make_live();
    long first_change(const track::Timeline& before, const track::Timeline& after) const;
    void wake() { quiet_ = held_ = 0; }
    bool touched() const { return !overrides_.empty() || !hands_.empty(); }
    long last_frame() const;
    double time_s() const { return static_cast<double>(frame_) / 60; }
    Vec3 offset_of(int vertex, const JsonCursor& point_m) const;
    track::Drive live_drive(double t_s) const;
    static track::PullTrack track_of(const HandPull& hand);
    void record_hands();
    void record_channels();
    void finish_recording();

    // What ticks do
    bool tick_playing();
    bool tick_seeking();
    bool tick_live();
    bool compute_until(long frame);
    void begin_take(const face::DriveAt& drive);
    void show(const face::FacePose& pose, double t_s, const track::Drive& drive);
    void show_taken(long frame);
    void recover();
    void restart_face();

    SessionInputs inputs_;
    track::ChannelTable channels_;
    Document document_;
    track::ScriptDescription script_;
    std::unique_ptr<face::Face> face_;
    render::Scene scene_;
    DrawnVertices drawn_;
    Triangles skin_;          // over the drawn vertices
    std::vector<char> soft_;  // per vertex of the mesh
    double unit_m_ = kFinestUnit_m;

    std::unique_ptr<track::Timeline> timeline_, live_;
    std::map<std::string, double> overrides_;
    std::set<std::string> performed_;  // overrides that a camera has made
    std::map<int, HandPull> hands_;
    bool recording_ = false;
    Recording recorded_;  // since recording began
    Take take_;
    Moments moments_;       // of the frames that take_ has
    long frame_ = 0;        // the playhead, 1/60 s
    long face_frame_ = -1;  // the frame of the take at which the face is, or -1
    long wanted_ = -1;      // the frame to be computed while not playing, or -1
    bool playing_ = false, loop_ = false;
    int every_ = 1, waited_ = 0;  // play: ticks per frame
    int quiet_ = kQuietTicks;     // ticks without motion
    int held_ = 0;        // ticks with the drive of the playhead held, since something changed
    bool fails_ = false;  // the script cannot be computed up to the playhead
    Points last_nodes_;
    bool with_strain_ = false, with_muscles_ = false;
    std::string selected_;
    PoseFrame shown_;
    struct Unseen {
        double t_s;
        track::Drive drive;
    };
    std::optional<Unseen> unseen_;  // a step whose pose has not been computed yet

    long ticks_ = 0;
    std::vector<std::pair<long, std::string>> log_;
    std::vector<std::string> events_;
    bool document_changed_ = false;

    static constexpr int kQuietTicks = 12, kLongestHold = 90;
};

/// Makes the ticks and messages of a log. Call it with a session that has just been built from the same inputs.
void replay(const Json& log, Session& session);

}  // namespace risorius::view
