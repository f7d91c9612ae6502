#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Stops long commands at moments spread over their whole run, with INT, TERM and HUP in turn, and looks at what is left.

After a stop the output must be absent or the former one, or the whole new one when the run was not interrupted, with no hidden file, no
temporary file and no process left. Every second run has a former output. Prints for each command how long a run was still there after the
signal, on the clock and in processor time. Exit code 1: a promise is broken.

    stops.py PROGRAM                     render, fit, calibrate (fit with strengths), head, shapes and batch, 40 stops each
    stops.py PROGRAM render --stops 4    one command, fewer stops
    stops.py PROGRAM --within 1          a run that is there for longer after its signal breaks a promise, too
"""
import argparse
import json
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from io_errors import ROOT, Command, design_of, state_of  # noqa: E402

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
TICKS = os.sysconf("SC_CLK_TCK")


def commands(scratch):
    """Each works for some seconds: set-up, simulation, drawing and writing all take their part."""
    rig, mesh = ROOT / "rigs/adult/rig.json", ROOT / "models/adult/head.obj"

    def render(size):
        return ["render", ROOT / "samples/smile/script.json", "-o", "{out}/x.mp4", "--draft", "--size", size]

    def fit(name, strengths):
        return ["fit", mesh, "--landmarks", mesh.with_name("landmarks.json"), "-o", "{out}/rig.json",
                strengths, "--name", name, "--report", "{out}/report"]

    def head(seed):
        return ["head", "-o", "{out}/h", "--seed", seed, "--texture", "512"]

    def shapes(names):
        return ["shapes", rig, "-o", "{out}/s", "--only", names, "--test-frames", "1", "--texture", "256"]

    def batch(name, duration_s):
        (scratch / name).write_text(json.dumps(design_of(duration_s, 96)))
        return ["batch", scratch / name, "-o", "{out}/b"]

    return [
        Command("render", render("256x256"), render("48x48")),
        Command("fit", fit("new", "--no-calibrate"), fit("former", "--no-calibrate")),
        Command("calibrate", fit("new", "--muscles-apart"), fit("former", "--no-calibrate")),
        Command("head", head("1"), head("2")),
        Command("shapes", shapes("jawOpen,mouthPucker"), shapes("jawOpen")),
        Command("batch", batch("new.json", 1), batch("former.json", 0.05), parts=True),
    ]


class Stops:
    def __init__(self, program, command, scratch):
        self.program, self.command, self.scratch = program, command, scratch
        self.broken, self.after = 0, []  # for each stop: (seconds until the run is gone, processor time, what it was)
        self.temporary, self.cache = scratch / "temporary", scratch / "cache"
        self.former, _ = self.whole_run(command.former, "former")
        self.whole, self.run_s = self.whole_run(command.new, "whole")
        assert self.former != self.whole

    def start(self, arguments, out):
        """The program in a session of its own, with nothing in its cache."""
        for folder in (self.temporary, self.cache):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
        words = [self.program] + [str(word).format(out=out) for word in arguments]
        with open(self.scratch / "errors", "wb") as errors:
            return subprocess.Popen(words, cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors,
                start_new_session=True, env={**os.environ, "RISORIUS_DATA": str(ROOT), "TMPDIR": str(self.temporary),
                                             "RISORIUS_CACHE": str(self.cache)})

    def whole_run(self, arguments, name):
        out, begin = self.scratch / name, time.monotonic()
        out.mkdir()
        code = self.start(arguments, out).wait()
        run_s = time.monotonic() - begin
        assert code == 0, (self.scratch / "errors").read_bytes()
        files, hidden = state_of(out)
        assert not hidden, hidden
        return files, run_s

    def tell(self, where, what, seen):
        self.broken += 1
        print(f"{self.command.name}: {where}: {what}: {seen}", flush=True)

    def stop(self, index, count, within_s):
        moment_s, number, former = (index + 0.5) / count * self.run_s, SIGNALS[index % 3], index % 2
        where = f"{number.name} after {moment_s:.2f} s, {'with' if former else 'without'} a former output"
        out = self.scratch / "out"
        shutil.rmtree(out, ignore_errors=True)
        if former:
            shutil.copytree(self.scratch / "former", out)
        else:
            out.mkdir()
        child = self.start(self.command.new, out)
        time.sleep(moment_s)
        worked_s = processor_s(child.pid)
        begin = time.monotonic()
        os.kill(child.pid, number)
        _, status, usage = os.wait4(child.pid, 0)
        after_s = time.monotonic() - begin
        child.returncode = os.waitstatus_to_exitcode(status)
        if worked_s is not None:
            self.after.append((after_s, usage.ru_utime + usage.ru_stime - worked_s, where))
            if within_s and after_s > within_s:
                self.tell(where, "seconds until it was gone", round(after_s, 2))
        self.judge(out, former, child.returncode, number, where)
        try:
            os.killpg(child.pid, 0)
            self.tell(where, "a process is left of the group", child.pid)
        except ProcessLookupError:
            pass

    def judge(self, out, former, code, number, where):
        files, hidden = state_of(out)
        errors = (self.scratch / "errors").read_bytes()
        before = self.former if former else {}
        if code not in (0, 130, -number):
            self.tell(where, "exit code", (code, errors))
        if code == 0 and files != self.whole:
            self.tell(where, "not whole after success", sorted(files))
        # A set may have finished some of its clips.
        of_both = all(files[name] in (self.former.get(name), self.whole.get(name)) for name in files)
        if code != 0 and files != before and not (self.command.parts and of_both):
            self.tell(where, "neither absent nor the former output", sorted(files))
        if code == 130 and (files == self.whole or not errors.startswith(b"risorius: interrupted")):
            self.tell(where, "it says that it was interrupted", errors)
        left = [path.name for path in self.temporary.iterdir()]
        if hidden or left:
            self.tell(where, "left behind", (hidden, left))

    def all(self, count, within_s):
        for index in range(count):
            self.stop(index, count, within_s)
        if not self.after:
            self.tell("all stops", "the run was over before each", self.run_s)
            return self.broken
        worst_s, _, where = max(self.after)
        median_s, most_s = statistics.median(one[0] for one in self.after), max(one[1] for one in self.after)
        print(f"{self.command.name}: {self.run_s:.1f} s, {len(self.after)} stops, {count - len(self.after)} too late, gone after "
              f"{median_s:.2f} s (median), {worst_s:.2f} s (worst: {where}), at most {most_s:.2f} s of processor time, "
              f"{self.broken} broken promises", flush=True)
        return self.broken


def processor_s(process):
    """Processor time of a process and the children that it has waited for; None: it is over."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
    return None if fields[0] == "Z" else sum(map(int, fields[11:15])) / TICKS


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("commands", nargs="*")
    parser.add_argument("--stops", type=int, default=40)
    parser.add_argument("--within", type=float, help="seconds")
    arguments = parser.parse_args()
    for number in SIGNALS:  # what this program was started to ignore, as with nohup, the other one would ignore too
        signal.signal(number, signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL)
    broken = 0
    with tempfile.TemporaryDirectory() as base:
        for command in commands(pathlib.Path(base)):
            if not arguments.commands or command.name in arguments.commands:
                scratch = pathlib.Path(base) / command.name
                scratch.mkdir()
                broken += Stops(arguments.program.resolve(), command, scratch).all(arguments.stops, arguments.within)
    sys.exit(1 if broken else 0)


main()
