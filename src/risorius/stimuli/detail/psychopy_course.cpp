// SPDX-License-Identifier: MIT
// The text of experiment.py: its trials, in their order.
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace {

const char* const kCourse = R"py(

class QuestPlus:
    """QUEST+ (Watson 2017, Journal of Vision 17(3), 10): threshold, slope and lapses of a Weibull function are unknown. Each trial
    shows the level, among those that there are, after whose answer least is expected to remain unknown (entropy). Levels are
    in log10. `guess`: the share of right answers by chance."""

    RIGHT = 0.82  # the threshold is where so many answers are right
    SLOPES, LAPSES = (1, 1.5, 2, 3, 4.5, 7, 10), (0, 0.02, 0.05)

    def __init__(self, levels, trials, guess):
        self.levels, self.trials, self.data = levels, trials, []
        low, high = levels[0] - 0.3, levels[-1] + 0.3
        steps = max(20, round((high - low) / 0.025))
        self.states = [
            (low + (high - low) * step / steps, slope, lapse)
            for step in range(steps + 1) for slope in self.SLOPES for lapse in self.LAPSES
        ]
        self.right = [
            [1 - lapse - (1 - guess - lapse) * math.exp(-(10 ** (slope * (level - middle))))
             for middle, slope, lapse in self.states]
            for level in levels
        ]
        self.at_right = [
            middle + math.log10(-math.log((1 - lapse - self.RIGHT) / (1 - guess - lapse))) / slope
            for middle, slope, lapse in self.states
        ]
        self.belief = [1 / len(self.states)] * len(self.states)

    def _unknown_after(self, right):
        """The entropy that is expected after a trial."""
        out = 0
        for shares in (right, [1 - one for one in right]):
            both = [share * belief for share, belief in zip(shares, self.belief)]
            all_of_it = sum(both)
            out += all_of_it * math.log(all_of_it) - sum(one * math.log(one) for one in both if one > 0)
        return out

    def __next__(self):
        if len(self.data) >= self.trials:
            raise StopIteration
        unknown = [self._unknown_after(right) for right in self.right]
        return self.levels[unknown.index(min(unknown))]

    def addResponse(self, result, intensity):
        self.data.append(result)
        right = self.right[min(range(len(self.levels)), key=lambda at: abs(self.levels[at] - intensity))]
        belief = [(share if result else 1 - share) * one for share, one in zip(right, self.belief)]
        self.belief = [one / sum(belief) for one in belief]

    def _mean(self, values):
        return sum(value * one for value, one in zip(values, self.belief))

    def mean(self):
        return self._mean(self.at_right)

    def sd(self):
        middle = self.mean()
        return math.sqrt(self._mean([(one - middle) ** 2 for one in self.at_right]))

    def slope(self):
        return self._mean([slope for _, slope, _ in self.states])

    def lapse(self):
        return self._mean([lapse for _, _, lapse in self.states])


class Course:
    """Which clip each trial shows. The order is drawn by the seed.

    constant             every clip, `repetitions` times
    the others           a threshold for each series of clips: from trial to trial the clip whose level is nearest to what the
                         method asks for. A staircase goes down after three right answers and up after a wrong one (79 % right);
                         quest works in log10 of the level, with the slope of a Weibull function of 3.5 (82 % right); questplus
                         finds slope and lapses too."""

    def __init__(self, settings, rows, chance):
        self.chance, self.method = chance, settings["method"]
        self.series, self.handlers = {}, {}
        if self.method == "constant":
            slots = [{"kind": "trial", "clip": row} for _ in range(settings["repetitions"]) for row in rows]
        else:
            for row in rows:
                if row["level"]:
                    self.series.setdefault(row["series"], []).append({**row, "level": float(row["level"])})
            for name, clips in self.series.items():
                self.handlers[name] = self._handler(clips, settings)
            slots = [{"kind": "trial", "series": name} for name in self.series for _ in range(settings["trials"])]
        slots += [{"kind": "catch", "clip": chance.choice(rows)} for _ in range(round(settings["catch"] * len(slots)))]
        chance.shuffle(slots)
        for number, slot in enumerate(slots):
            slot["block"] = 1 + number * settings["blocks"] // len(slots)
        pool = []
        while len(pool) < settings["practice"]:
            pool += chance.sample(rows, len(rows))
        self.slots = [{"kind": "practice", "block": 0, "clip": clip} for clip in pool[: settings["practice"]]] + slots

    def _handler(self, clips, settings):
        from psychopy import data

        levels = sorted(clip["level"] for clip in clips)
        if self.method == "staircase":
            return data.StairHandler(
                startVal=levels[-1], nReversals=1, stepSizes=[0.2, 0.1, 0.1, 0.05], nTrials=settings["trials"], nUp=1,
                nDown=3, stepType="log", minVal=levels[0], maxVal=levels[-1],
            )
        low, high = math.log10(levels[0]), math.log10(levels[-1])
        if self.method == "questplus":
            return QuestPlus([math.log10(one) for one in sorted(set(levels))], settings["trials"], 1 / len(settings["answers"]))
        return data.QuestHandler(
            startVal=(low + high) / 2, startValSd=max(0.3, high - low), pThreshold=0.82, nTrials=settings["trials"],
            beta=3.5, delta=0.01, gamma=1 / len(settings["answers"]), grain=0.01, minVal=low, maxVal=high,
        )

    def clip_of(self, slot):
        """The clip of a trial; none when its series has come to its end."""
        if "series" not in slot:
            return dict(slot["clip"])
        try:
            asked = next(self.handlers[slot["series"]])
        except StopIteration:
            return None
        asked = math.log10(asked) if self.method == "staircase" else asked
        away = [(abs(math.log10(clip["level"]) - asked), clip) for clip in self.series[slot["series"]]]
        nearest = min(distance for distance, _ in away)
        return dict(self.chance.choice([clip for distance, clip in away if distance <= nearest + 0.03]))

    def answered(self, slot, clip, correct):
        """Tells the method what was shown, which is not quite what it asked for, and how it was answered."""
        if "series" in slot:
            shown = clip["level"] if self.method == "staircase" else math.log10(clip["level"])
            self.handlers[slot["series"]].addResponse(int(correct), intensity=shown)

    def thresholds(self):
        out = []
        for name, handler in self.handlers.items():
            if not len(handler.data):
                continue
            if self.method == "staircase":
                turns = handler.reversalIntensities[-6:]
                level, sd = sum(turns) / len(turns) if turns else float("nan"), ""
            else:
                level, sd = 10 ** handler.mean(), f"{handler.sd():.4f}"
            row = {"series": name, "method": self.method, "trials": len(handler.data), "threshold": f"{level:.4f}",
                   "sd_log10": sd}
            if self.method == "questplus":
                row.update(slope=f"{handler.slope():.3f}", lapse=f"{handler.lapse():.3f}")
            out.append(row)
        return out


def show(screen, frames, codes, refreshes, heard, began, dot):
    """Shows a clip, and the blank screen after it while the last code is on the line. `dot`: what is seen on top of it, and
    from which refresh on."""
    window = screen.window
    number_of_dot = range(0)
    if dot:
        number_of_dot = range(dot["from"], dot["from"] + max(1, round(CATCH_S * screen.rate_hz)))
    for number, picture in enumerate(frames):
        for refresh in range(refreshes):
            if number == 0 and refresh == 0:
                window.callOnFlip(screen.clock.reset)
                window.callOnFlip(began)
                if heard:
                    heard.play(when=window.getFutureFlipTime(clock="ptb"))
            now = number * refreshes + refresh
            marker = codes.get(number) if refresh == 0 else None
            if dot and now == dot["from"]:
                marker = marker or CATCH
            screen.flip([picture, dot["drawn"]] if now in number_of_dot else [picture], marker)
    screen.flip([], codes.get(len(frames)))
    while screen.left:
        screen.flip([])
    if heard:
        heard.stop()


def ask(screen, settings, keys, texts, dot_s):
    """The answer after the clip, unless it came during the clip. `dot_s`: when the red dot of a catch trial came. Returns the key,
    its time from the question, and whether the key for the dot was pressed without a dot."""
    answer_keys = [one["key"] for one in settings["answers"]]
    catch = dot_s is not None
    during = [*(answer_keys if settings["answer_during"] and not catch else []), "escape"]
    dot_key = [CATCH_KEY] if settings["catch"] else []
    pressed = keys.read([*during, *dot_key])
    alarms = [key for key in pressed if key.name == CATCH_KEY and (not catch or key.rt < dot_s)]
    pressed = [key for key in pressed if key not in alarms]
    if catch:
        return (pressed or keys.wait([CATCH_KEY, "escape"], CATCH_WAIT_S) or [None])[0], None, bool(alarms)
    if pressed:
        return pressed[0], None, bool(alarms)
    question_s = {}
    screen.window.callOnFlip(lambda: question_s.update(at=keys.board.clock.getTime()))
    screen.flip([texts["question"]])
    key = keys.wait([*answer_keys, "escape"])[0]
    alarms += keys.read(dot_key) if dot_key else []
    if settings["response"] and key.name != "escape":
        screen.mark([], RESPONSE)
    return key, key.rt - question_s["at"], bool(alarms)


def run_trial(screen, settings, slot, clip, codes, refreshes, keys, texts, chance):
    """One trial. Returns what it adds to the row; none when the participant presses escape."""
    window, triggers = screen.window, screen.triggers
    screen.flip([])
    frames, heard = load_frames(window, clip), load_sound(clip)
    if keys.read(["escape"]):
        return None
    fixation_clock, began = core.Clock(), {}
    for refresh in range(round(settings["fixation_s"] * screen.rate_hz)):
        if refresh == 0:
            window.callOnFlip(fixation_clock.reset)
        screen.flip([texts["fixation"]])
    triggers.sent.clear()
    window.frameIntervals = []
    window.recordFrameIntervals = True

    def begin():
        began["fixation_s"], began["onset_s"] = fixation_clock.getTime(), keys.run_s()
        keys.restart()

    catch = slot["kind"] == "catch"
    dot = dot_s = None
    if catch:  # anywhere in the middle of the clip, with a frame of its own for its code where there is one
        free = [number for number in range(len(frames)) if number not in codes] or [0]
        middle = [number for number in free if 0.2 * len(frames) <= number <= 0.8 * len(frames)] or free
        dot = {"drawn": texts["dot"], "from": chance.choice(middle) * refreshes}
        dot_s = dot["from"] / screen.rate_hz
    show(screen, frames, codes, refreshes, heard, begin, dot)
    window.recordFrameIntervals = False
    intervals = list(window.frameIntervals)
    key, reaction_s, false_alarm = ask(screen, settings, keys, texts, dot_s)
    if key and key.name == "escape":
        return None
    if catch:
        correct = int(key is not None)
    else:
        correct = int(key.name == clip["correct_key"]) if clip["correct_key"] else ""
    period = 1 / screen.rate_hz
    late = max([interval - period for interval in intervals], default=0)
    return {
        "key": key.name if key else "",
        "answer": next((one["answer"] for one in settings["answers"] if key and one["key"] == key.name), ""),
        "correct": correct,
        "false_alarm": int(false_alarm) if settings["catch"] else "",
        "reaction_s": "" if reaction_s is None else f"{reaction_s:.4f}",
        "response_time": f"{key.rt:.4f}" if key else "",
        "onset_s": f"{began['onset_s']:.4f}",
        "fixation_s": f"{began['fixation_s']:.4f}" if settings["fixation_s"] else "0",
        "codes": " ".join(f"{code}@{time:.4f}" for code, time in triggers.sent),
        "dropped_refreshes": sum(interval > 1.5 * period for interval in intervals),
        "late_ms_max": f"{1000 * late:.2f}",
    }


ADDED = ["key", "answer", "correct", "false_alarm", "reaction_s", "response_time", "onset_s", "fixation_s", "codes",
         "dropped_refreshes", "late_ms_max"]


def begin_block(screen, settings, keys, texts, before, block):
    """A pause between two blocks, and the code of the one that begins."""
    if before is not None:
        note = "The practice is over." if before == 0 else f"Block {before} of {settings['blocks']} is over."
        texts["pause"].text = f"{note}\n\nPress any key to go on."
        screen.mark([texts["pause"]], PAUSE)
        screen.flip([texts["pause"]])
        keys.wait()
    if block == 0:
        screen.mark([], PRACTICE)
    elif settings["blocks"] > 1:
        screen.mark([], BLOCK)


def run_trials(screen, settings, course, codes, refreshes, keys, texts, answers, options):
    """All trials. Returns how the red dots were answered: a row for the table of results."""
    block, dots = None, {"catch_trials": 0, "hits": 0, "other_trials": 0, "false_alarms": 0}
    for number, slot in enumerate(course.slots):
        if slot["block"] != block:
            begin_block(screen, settings, keys, texts, block, slot["block"])
            block = slot["block"]
        row = course.clip_of(slot)
        if row is None:
            continue
        clip = {**row, "file": str(HERE / settings["clips"] / row["stim_file"])}
        screen.triggers.trial = {"stim_id": clip["stim_id"], "trial": number}
        added = run_trial(
            screen, settings, slot, clip, codes[clip["stim_id"]], refreshes[clip["stim_id"]], keys, texts, course.chance
        )
        if added is None:
            break
        course.answered(slot, row, added["correct"] == 1)
        if slot["kind"] == "catch":
            dots["catch_trials"] += 1
            dots["hits"] += added["correct"]
        elif slot["kind"] == "trial":
            dots["other_trials"] += 1
        if settings["catch"] and slot["kind"] != "practice":
            dots["false_alarms"] += added["false_alarm"]
        kind = " ".join(text for text in (clip["set"], clip["control"]) if text)
        place = {"trial": number, "block": slot["block"], "kind": slot["kind"]}
        answers.add(
            {**row, "participant": options.participant, **place, **added},
            {
                "onset": added["onset_s"], "duration": f"{duration_s(clip):.4f}", "trial_type": kind,
                "response_time": added["response_time"], "stimulus_id": f"stim-{clip['stim_id']}",
                "stim_file": clip["stim_file"], **place,
                "answer": added["answer"], "correct": added["correct"], "false_alarm": added["false_alarm"],
                "dropped": added["dropped_refreshes"],
            },
            keys.pulses_s,
        )
        keys.pulses_s = []
        if slot["kind"] == "practice" and added["correct"] != "":
            screen.stay([texts["right" if added["correct"] else "wrong"]], FEEDBACK_S)
    return [dots] if settings["catch"] else []


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--participant', default="0")
    parser.add_argument('--run', type=int, default=1, help="its number, for the names of the files")
    parser.add_argument('--seed', type=int, help="of the order; by default the participant's name")
    parser.add_argument('--trigger-port', default="", help="a serial port, or the address of a parallel port as 0x0378")
    parser.add_argument('--window', action="store_true", help="not the whole screen")
    options = parser.parse_args()

    settings = json.loads((HERE / "settings.json").read_text(encoding="utf-8"))
    codes, rows = read_codes(), read_conditions()
    course = Course(settings, rows, random.Random(options.participant if options.seed is None else options.seed))

    # All checks come before the first file is opened.
    window = visual.Window(fullscr=not options.window, units="pix", color=settings["background"], colorSpace="hex")
    window.mouseVisible = False
    rate_hz = window.getActualFrameRate(nIdentical=10, nMaxFrames=100, nWarmUpFrames=10, threshold=1)
    if rate_hz is None:
        raise RuntimeError("the screen's refresh rate cannot be measured")
    refreshes = {clip["stim_id"]: refreshes_of(clip, rate_hz) for clip in rows}
    triggers = Triggers(options.trigger_port, settings["name"] if settings["lsl"] else "")
    screen = Screen(window, rate_hz, triggers, core.Clock(), settings["pulse_ms"])
    for name, its in codes.items():
        frames = sorted(its)
        if name in refreshes and any((b - a) * refreshes[name] <= screen.pulse for a, b in zip(frames, frames[1:])):
            print(f"note: {name}: two of its codes follow one another without a zero between them")

    choices = "    ".join(f"{one['key']} = {one['answer']}" for one in settings["answers"])
    told = f"{settings['question']}\n\n{choices}\n\n"
    if settings["catch"]:
        told += f"Press {CATCH_KEY} as soon as you see a red dot.\n\n"
    texts = {
        "question": visual.TextStim(window, text=f"{settings['question']}\n\n{choices}"),
        "fixation": visual.TextStim(window, text="+", height=48),
        "pause": visual.TextStim(window, text=""),
        "right": visual.TextStim(window, text="Right"),
        "wrong": visual.TextStim(window, text="Wrong"),
        "dot": visual.Circle(window, radius=12, lineWidth=0, fillColor="red"),
    }
    keys = Keys(settings["wait_for"])
    screen.flip([visual.TextStim(window, text=f"{told}Press any key to begin.")])
    keys.wait()
    keys.begin_run()
    if settings["wait_for"]:
        screen.flip([visual.TextStim(window, text="Waiting for the scanner")])
        keys.wait_for_scanner(settings["dummy_volumes"])
        screen.mark([], SCANNER)

    software = {"SoftwareName": "PsychoPy, with a program by Risorius", "OperatingSystem": os.sys.platform,
                "RefreshRate": rate_hz}
    answers = Answers(options, settings, ["participant", "trial", "block", "kind", *rows[0], *ADDED], software)
    dots = run_trials(screen, settings, course, codes, refreshes, keys, texts, answers, options)
    answers.table("catch", dots)
    answers.table("thresholds", course.thresholds())
    window.close()
    core.quit()


if __name__ == "__main__":
    main()
)py";

}  // namespace

const char* psychopy_course() { return kCourse; }

}  // namespace risorius::stimuli
