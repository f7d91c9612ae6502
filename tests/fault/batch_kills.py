#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills `batch` before its renames, again and again in one folder, until the set is complete. What is there must always be whole, and the
end must be the set of a run that nobody disturbed.

    batch_kills.py PROGRAM LIBRARY                 before rename 5 of the first run, 10 of the second and so on, for ctest
    batch_kills.py PROGRAM LIBRARY --step 1        before rename 1, 2 and so on
    batch_kills.py PROGRAM LIBRARY --each          one kill and one more run for every rename of a run, each in a new folder
"""
import argparse
import hashlib
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def design(clips):
    """A matched set with three clips for each of one or two expressions, areas of interest and experiments."""
    return {
        "format": "risorius-design", "version": 1, "name": "Killed",
        "clips": {"quality": "draft", "aois": ["mouth"]},
        "match": {"luminance": {"within": "face", "mean": 0.25, "sd": 0.08}},
        "experiment": {"programs": ["psychopy", "jspsych", "rating"], "correct": "expression",
                       "answers": {"h": "happiness", "f": "fear"}},
        "sets": [{
            "name": "a", "clip": "${expression}", "controls": ["reversed", "phase_scrambled"],
            "factors": {"expression": ["happiness", "fear"][:clips // 3]},
            "script": {
                "format": "risorius-script", "version": 1, "rig": str(ROOT / "rigs/adult/rig.json"),
                "fps": 10, "duration_s": 0.4,
                "events": [{"expression": "${expression}", "start_s": 0.05, "onset_s": 0.1}],
                "view": {"width_px": 64, "height_px": 64, "antialiasing": 1}}}]}


def files_of(folder):
    """The files that a reader sees: for each a checksum. Private and unmatched ones are left out."""
    out = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and not name.startswith((".risorius-", "intermediate/")):
            out[name] = hashlib.sha256(path.read_bytes()).hexdigest()
    return out


def all_names(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


class Kills:
    def __init__(self, arguments, scratch):
        self.arguments, self.scratch, self.broken = arguments, scratch, 0
        (scratch / "design.json").write_text(json.dumps(design(arguments.clips)))
        done = self.run(scratch / "whole", {})
        assert done.returncode == 0, done.stderr
        self.whole, self.names = files_of(scratch / "whole"), all_names(scratch / "whole")

    def run(self, out, environment):
        command = [self.arguments.program.resolve(), "batch", self.scratch / "design.json", "-o", out, "--quiet",
                   "--workers", str(self.arguments.workers)]
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, timeout=600,
                              env={**os.environ, "RISORIUS_DATA": str(ROOT), **environment})

    def fault(self, out, **more):
        return {"LD_PRELOAD": str(self.arguments.library.resolve()), "FAULT_BELOW": str(out),
                "FAULT_KIND": "rename", **more}

    def killed(self, out, at):
        """Whether a run was killed before this rename, and not done before. What is there is looked at."""
        done = self.run(out, self.fault(out, FAULT_AT=str(at), FAULT_SIGNAL=str(int(signal.SIGKILL))))
        if done.returncode not in (0, -signal.SIGKILL):
            self.tell(out, f"exit code {done.returncode}", done.stderr)
        half = [name for name, sha256 in files_of(out).items() if self.whole.get(name) != sha256]
        if half:
            self.tell(out, "other bytes than in the end", half)
        return done.returncode == -signal.SIGKILL

    def finish(self, out):
        done = self.run(out, {})
        if done.returncode != 0 or files_of(out) != self.whole or all_names(out) != self.names:
            self.tell(out, "not the set of an undisturbed run",
                      (done.stderr, sorted(set(all_names(out)) ^ set(self.names))))

    def tell(self, out, what, seen):
        self.broken += 1
        print(f"{out.name}: {what}: {seen}", flush=True)

    def again_and_again(self):
        out, runs = self.scratch / "again", 0
        # A run that is killed ever later comes to its end at last.
        while self.killed(out, (runs + 1) * self.arguments.step):
            runs += 1
        self.finish(out)
        print(f"{runs} kills in one folder, {self.broken} broken promises", flush=True)
        assert runs > 2

    def each(self):
        log = self.scratch / "log"
        self.run(self.scratch / "count", self.fault(self.scratch / "count", FAULT_LOG=str(log)))
        renames = len(log.read_text().splitlines())
        for at in range(1, renames + 1):
            out = self.scratch / f"at-{at}"
            if not self.killed(out, at):
                self.tell(out, "not killed", at)
            self.finish(out)
        print(f"{renames} kills in a folder each, {self.broken} broken promises", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--step", type=int, default=5)
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--clips", type=int, choices=(3, 6), default=3)
    parser.add_argument("--workers", type=int, default=2)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as base:
        kills = Kills(arguments, pathlib.Path(base))
        if arguments.each:
            kills.each()
        else:
            kills.again_and_again()
        sys.exit(1 if kills.broken else 0)


main()
