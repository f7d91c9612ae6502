// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/experiment_programs.h"

#include <array>

#include "risorius/report/html_writer.h"

namespace risorius::stimuli {

namespace {

/// A published file of jsPsych, and the hash by which a browser checks it.
struct PublishedFile {
    const char* package;
    const char* version;
    const char* file;
    const char* integrity;
};
constexpr std::array<PublishedFile, 5> kJsPsych{{
    {"jspsych", "8.2.3", "css/jspsych.css",
     "sha384-JNNpz6XWsC9uPPHlCuf9rr6LrSD2uYvbkApP5kAp6g/lFBue51K1kMzxGawS50nK"},
    {"jspsych", "8.2.3", "dist/index.browser.min.js",
     "sha384-rSMOcLayYRCXgf6ExTgyY+tTIgmnwYS8gZvBHBnKEesX9CWsOIpI8vAvCHllhsAE"},
    {"@jspsych/plugin-html-keyboard-response", "2.1.0", "dist/index.browser.min.js",
     "sha384-JyKpJgu7DU4Cgu1+TTOMRxkNWsYCT5ENOipB9fwXibgV4+N2XZXtlfyjbkMv8Hgp"},
    {"@jspsych/plugin-video-keyboard-response", "2.1.1", "dist/index.browser.min.js",
     "sha384-2EmyERJMIl3pISnjhXDJphPAi4VxAMjimEoWvObgiqe9cw43o4eheWPvsmu+XxyT"},
    {"@jspsych/plugin-preload", "2.1.0", "dist/index.browser.min.js",
     "sha384-BiUYHx4tdTYToceth936qf4Wkf+Ho2VZti/5bB5/nDiPRuTaZ37hrxkLsANkHGdp"},
}};

/// Loads from a URL with version and hash, or from a folder of installed packages.
std::string load(const PublishedFile& one, const std::string& from) {
    const bool remote = from.rfind("https://", 0) == 0 || from.rfind("http://", 0) == 0;
    const std::string address = report::html_escaped(
        from + "/" + one.package + (remote ? "@" + std::string(one.version) : std::string()) + "/" +
        one.file);
    const std::string guard =
        remote ? " integrity=\"" + std::string(one.integrity) + "\" crossorigin=\"anonymous\""
               : std::string();
    if (std::string(one.file).ends_with(".css"))
        return "<link rel=\"stylesheet\" href=\"" + address + "\"" + guard + ">\n";
    return "<script src=\"" + address + "\"" + guard + "></script>\n";
}

/// JSON for a script element, escaped so that it cannot end the element.
std::string within_script(std::string json) {
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;)
        json.replace(at, 1, "\\u003c");
    return json;
}

const char* const kPage = R"js(
'use strict';
// An example to start from. The address may say ?participant=7, ?seed=1 for an order that can be had again, and ?save=URL:
// the data are sent there as JSON when all is done, and offered as a file otherwise.
const asked = new URLSearchParams(location.search);
const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
document.body.style.background = settings.background;
const jsPsych = initJsPsych({on_finish: finish});
if (asked.has('seed')) jsPsych.randomization.setSeed(asked.get('seed'));
jsPsych.data.addProperties({participant: asked.get('participant') || ''});

const said = settings.answers.map((one) => `<kbd>${escaped(one.key)}</kbd> ${escaped(one.answer)}`).join(' &nbsp; ');
const wait = {type: jsPsychHtmlKeyboardResponse, choices: 'ALL_KEYS',
    stimulus: `<p>${escaped(settings.question)}</p><p>${said}</p><p>Press any key to begin.</p>`};
const fixation = {type: jsPsychHtmlKeyboardResponse, stimulus: '<p style="font-size: 48px">+</p>',
    choices: 'NO_KEYS', trial_duration: 1000 * settings.fixation_s};

// The clip itself, and how well the browser kept up with its frames
function shown(clip) {
    let begun = null, seen = 0;
    return {
        type: jsPsychVideoKeyboardResponse, stimulus: [settings.clips + clip.stim_file], choices: 'NO_KEYS',
        trial_ends_after_video: true, data: {...clip, task: 'clip'},
        on_load: () => {
            const video = document.querySelector('video');
            const note = (now) => {
                begun = begun === null ? now : begun;
                ++seen;
                video.requestVideoFrameCallback(note);
            };
            if (video.requestVideoFrameCallback) video.requestVideoFrameCallback(note);
        },
        on_finish: (data) => {
            data.first_frame_ms = begun;
            data.frames_seen = seen;
        },
    };
}

function answered(clip) {
    return {
        type: jsPsychHtmlKeyboardResponse, stimulus: `<p>${escaped(settings.question)}</p><p>${said}</p>`,
        choices: settings.answers.map((one) => one.key), data: {...clip, task: 'answer'},
        on_finish: (data) => {
            const one = settings.answers.find((answer) => answer.key === data.response);
            data.answer = one ? one.answer : null;
            if (clip.correct_key) data.correct = data.response === clip.correct_key;
        },
    };
}

const clips = jsPsych.randomization.repeat(conditions, settings.repetitions);
const files = [...new Set(conditions.map((clip) => settings.clips + clip.stim_file))];
const timeline = [{type: jsPsychPreload, video: location.protocol === 'file:' ? [] : files}, wait];
for (const clip of clips) timeline.push(fixation, shown(clip), answered(clip));
jsPsych.run(timeline);

function finish() {
    const data = jsPsych.data.get();
    if (asked.has('save'))
        fetch(asked.get('save'), {method: 'POST', headers: {'Content-Type': 'application/json'}, body: data.json()});
    else
        data.localSave('csv', `data-${asked.get('participant') || 'participant'}.csv`);
    jsPsych.getDisplayElement().innerHTML = '<p>Thank you.</p>';
}
)js";

const char* const kProgram = R"py(#!/usr/bin/env python3
"""An experiment with a set of clips, for PsychoPy: an example to start from.

    python experiment.py --participant 7

Every clip is decoded before it is shown and its frames are flipped one by one, each for a whole number of refreshes of the
screen, so that no player decides when a frame is seen. Codes go out with the flip they belong to: 1 when the clip begins,
2 at its movement_onset, 3 at its apex, 4 when it has ended, as in ../triggers.tsv. A square in the corner is white
in the refreshes in which a code is sent, for a photodiode.

It reads settings.json and conditions.csv beside it and writes data/PARTICIPANT.csv.
"""
import argparse
import csv
import json
import random
from pathlib import Path

import imageio
from PIL import Image
from psychopy import core, event, visual

HERE = Path(__file__).resolve().parent
CODES = {"clip_on": 1, "movement_onset": 2, "apex": 3, "clip_off": 4}


class Triggers:
    """Codes to a serial port, a parallel port (an address like 0x0378), or nowhere; kept for the data in any case."""

    def __init__(self, port):
        self.port, self.serial, self.parallel = port, None, None
        self.sent = []
        if port and port.lower().startswith("0x"):
            from psychopy import parallel

            self.parallel = parallel.ParallelPort(address=int(port, 16))
        elif port:
            import serial

            self.serial = serial.Serial(port, 115200)

    def send(self, code, clock):
        if self.parallel:
            self.parallel.setData(code)
        elif self.serial:
            self.serial.write(bytes([code]))
        if code:
            self.sent.append((code, clock.getTime()))


def read_conditions():
    with open(HERE / "conditions.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for name in ("frames", "fps", "movement_onset_frame", "apex_frame"):
            row[name] = int(row[name])
    return rows


def load_frames(window, clip):
    """All pictures of a clip as textures; fails when they are not as many as the conditions say."""
    with imageio.get_reader(clip["file"], "ffmpeg") as reader:
        frames = [visual.ImageStim(window, image=Image.fromarray(frame)) for frame in reader]
    if len(frames) != clip["frames"]:
        raise RuntimeError(f"{clip['file']}: expected {clip['frames']} frames, found {len(frames)}")
    return frames


def load_sound(clip):
    if not clip.get("audio_file"):
        return None
    from psychopy import sound

    return sound.Sound(str(HERE / clip["audio_file"]))


def refreshes_of(clip, rate_hz):
    """How many refreshes of the screen every frame lasts."""
    count = round(rate_hz / clip["fps"])
    if count < 1 or abs(count * clip["fps"] / rate_hz - 1) > 0.02:
        raise RuntimeError(
            f"{clip['stim_id']}: {clip['fps']} frames per second do not divide the screen's {rate_hz:.1f} Hz"
        )
    return count


def show(window, clip, frames, heard, triggers, square, refreshes):
    clock = core.Clock()
    at = {0: "clip_on"}
    at.setdefault(clip["apex_frame"], "apex")
    at.setdefault(clip["movement_onset_frame"], "movement_onset")
    lit_before = False
    for number, picture in enumerate(frames):
        for refresh in range(refreshes):
            lit = refresh == 0 and number in at
            picture.draw()
            square.fillColor = "white" if lit else "black"
            square.draw()
            if number == 0 and refresh == 0:
                window.callOnFlip(clock.reset)
                if heard:
                    heard.play(when=window.getFutureFlipTime(clock="ptb"))
            if lit:
                window.callOnFlip(triggers.send, CODES[at[number]], clock)
            elif lit_before:
                window.callOnFlip(triggers.send, 0, clock)
            window.flip()
            lit_before = lit
    square.fillColor = "white"
    square.draw()
    window.callOnFlip(triggers.send, CODES["clip_off"], clock)
    window.flip()
    triggers.send(0, clock)
    if heard:
        heard.stop()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--participant', default="0")
    parser.add_argument('--seed', type=int, help="of the order; by default the participant's name")
    parser.add_argument('--trigger-port', default="", help="a serial port, or the address of a parallel port as 0x0378")
    parser.add_argument('--window', action="store_true", help="not the whole screen")
    options = parser.parse_args()

    settings = json.loads((HERE / "settings.json").read_text(encoding="utf-8"))
    trials = read_conditions() * settings["repetitions"]
    random.Random(options.participant if options.seed is None else options.seed).shuffle(trials)

    window = visual.Window(fullscr=not options.window, units="pix", color=settings["background"], colorSpace="hex")
    window.mouseVisible = False
    rate_hz = window.getActualFrameRate()
    if rate_hz is None:
        raise RuntimeError("the screen's refresh rate cannot be measured")
    triggers = Triggers(options.trigger_port)
    side = 64
    square = visual.Rect(
        window, width=side, height=side, lineWidth=0, fillColor="black",
        pos=((side - window.size[0]) / 2, (side - window.size[1]) / 2),
    )
    keys = [one["key"] for one in settings["answers"]]
    choices = "    ".join(f"{one['key']} = {one['answer']}" for one in settings["answers"])
    question = visual.TextStim(window, text=f"{settings['question']}\n\n{choices}")
    fixation = visual.TextStim(window, text="+", height=48)
    begin = visual.TextStim(window, text=f"{settings['question']}\n\n{choices}\n\nPress any key to begin.")
    begin.draw()
    window.flip()
    event.waitKeys()

    results = HERE / "data"
    results.mkdir(exist_ok=True)
    columns = ["participant", "trial", *trials[0], "key", "answer", "correct", "reaction_s", "codes", "dropped_refreshes"]
    with open(results / f"{options.participant}.csv", "w", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, columns)
        out.writeheader()
        for number, clip in enumerate(trials):
            clip = {**clip, "file": str(HERE / settings["clips"] / clip["stim_file"])}
            fixation.draw()
            window.flip()
            shown_since = core.Clock()
            frames, heard = load_frames(window, clip), load_sound(clip)
            refreshes = refreshes_of(clip, rate_hz)
            core.wait(max(0.0, settings["fixation_s"] - shown_since.getTime()))
            triggers.sent.clear()
            window.frameIntervals = []
            window.recordFrameIntervals = True
            show(window, clip, frames, heard, triggers, square, refreshes)
            window.recordFrameIntervals = False
            dropped = sum(interval > 1.5 / rate_hz for interval in window.frameIntervals)

            question.draw()
            window.flip()
            key, reaction_s = event.waitKeys(keyList=[*keys, "escape"], timeStamped=core.Clock())[0]
            if key == "escape":
                break
            answer = next(one["answer"] for one in settings["answers"] if one["key"] == key)
            row = {name: clip[name] for name in trials[0]}
            row.update(
                participant=options.participant, trial=number, key=key, answer=answer,
                correct=int(key == clip["correct_key"]) if clip["correct_key"] else "",
                reaction_s=f"{reaction_s:.4f}", dropped_refreshes=dropped,
                codes=" ".join(f"{code}@{time:.4f}" for code, time in triggers.sent),
            )
            out.writerow(row)
            file.flush()
    window.close()
    core.quit()


if __name__ == "__main__":
    main()
)py";

}  // namespace

const std::string& psychopy_program() {
    static const std::string text = kProgram;
    return text;
}

std::string jspsych_page(const std::string& title, const std::string& from,
                         const std::string& settings, const std::string& conditions) {
    std::string out =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
        report::html_escaped(title) + "</title>\n";
    for (const PublishedFile& one : kJsPsych) out += load(one, from);
    out += "</head>\n<body></body>\n<script>\nconst settings = " + within_script(settings) +
           ";\nconst conditions = " + within_script(conditions) + ";\n</script>\n<script>" + kPage +
           "</script>\n</html>\n";
    return out;
}

}  // namespace risorius::stimuli
