#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lets each operation on files below the output folder fail in turn, or ends the program there, and looks at what is left.

After each run, the output must be absent, the former one, or the new one, and whole. After one more run it must be whole, with no
hidden file beside it. Prints the number of operations and runs of each command. Exit code 1: a promise is broken.

    io_errors.py PROGRAM LIBRARY              a few operations of each command, for ctest
    io_errors.py PROGRAM LIBRARY --each       every operation with one fault, which changes from one to the next
    io_errors.py PROGRAM LIBRARY --all        every operation with every fault, which takes hours
    io_errors.py ... --part 2/5               of these, every fifth from the second on: the parts may run one after the other
"""
import argparse
import errno
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
ERRORS = [errno.ENOSPC, errno.EIO, errno.EMFILE]
SIGNALS = [signal.SIGKILL, signal.SIGINT, signal.SIGHUP]
TIMES = ("timing", "solving_s")  # keys of JSON files that may differ between two runs


def stable(path, folder):
    """The bytes of a file without names of folders; of a JSON file, what does not differ between two runs."""
    data = path.read_bytes()
    for name in ("former", "whole", "out"):  # records name the file that they belong to
        data = data.replace(str(folder.with_name(name)).encode(), b"OUT")
    if path.suffix == ".json":
        value = json.loads(data)
        if isinstance(value, dict):
            for key in TIMES:
                value.pop(key, None)
            return json.dumps(value, sort_keys=True).encode()
    return data


def state_of(folder):
    """What is in the folder: for each file a checksum. Hidden names are listed apart."""
    files, hidden = {}, []
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        # A set has one hidden file of its own: validators of BIDS look for it.
        if any(part.startswith(".") and part != ".bidsignore" for part in pathlib.PurePath(name).parts):
            hidden.append(name)
        elif path.is_file():
            files[name] = hashlib.sha256(stable(path, folder)).hexdigest()
    return files, hidden


class Command:
    """`new` and `former`: arguments with {out} for the folder. The outputs are everything in that folder.

    `parts`: the command makes several sets of outputs one after the other, each of which is whole."""

    def __init__(self, name, new, former, parts=False):
        self.name, self.new, self.former, self.parts = name, new, former, parts


def commands(scratch):
    def write(name, value):
        (scratch / name).write_text(json.dumps(value))

    script = {"format": "risorius-script", "version": 1, "rig": str(ROOT / "rigs/adult/rig.json"),
              "fps": 20, "duration_s": 0.1, "view": {"width_px": 64, "height_px": 64}}
    write("clip.json", script)
    for name, duration in (("new", 0.1), ("former", 0.05)):
        write(f"{name}.json", {
            "format": "risorius-design", "version": 1, "name": "two clips",
            "clips": {"quality": "draft"},
            "sets": [{"name": "a", "clip": "c${k}", "script": {**script, "duration_s": duration},
                      "factors": {"k": [1, 2]}}]})
    mesh = ROOT / "models/adult/head.obj"

    def render(size):
        return ["render", scratch / "clip.json", "-o", "{out}/x.mp4", "--draft", "--size", size]

    def fit(tables):
        return ["fit", mesh, "--landmarks", mesh.with_name("landmarks.json"), "-o",
                "{out}/rig.json", "--no-calibrate", "--name", tables, "--report", "{out}/report"]

    def shapes(name):
        return ["shapes", ROOT / "rigs/adult/rig.json", "-o", "{out}/s", "--only", name,
                "--no-pictures", "--no-correctives", "--test-frames", "0", "--formats", "glb,obj",
                "--texture", "0"]

    return [
        Command("render", render("64x64"), render("48x48")),
        Command("head", ["head", "-o", "{out}/h", "--mesh-only", "--seed", "1"],
                ["head", "-o", "{out}/h", "--mesh-only", "--seed", "2"]),
        Command("batch", ["batch", scratch / "new.json", "-o", "{out}/b", "--workers", "1"],
                ["batch", scratch / "former.json", "-o", "{out}/b", "--workers", "1"], parts=True),
        Command("shapes", shapes("jawOpen"), shapes("mouthPucker")),
        Command("fit", fit("new"), fit("former")),
    ]


def run(program, arguments, out, environment=None):
    command = [program] + [str(word).format(out=out) for word in arguments]
    return subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          env={**os.environ, "RISORIUS_DATA": str(ROOT), **(environment or {})}, timeout=900)


class Loop:
    def __init__(self, program, library, command, scratch):
        self.program, self.library, self.command, self.scratch = program, library, command, scratch
        self.runs = self.broken = 0
        self.former = self.reference(command.former, "former")
        self.whole = self.reference(command.new, "whole")
        assert self.former != self.whole

    def reference(self, arguments, name):
        """What the command writes when nothing fails. JSON is compared without times."""
        out = self.scratch / name
        out.mkdir()
        done = run(self.program, arguments, out)
        assert done.returncode == 0, done.stderr
        files, hidden = state_of(out)
        assert not hidden, hidden
        return files

    def fresh(self, with_former):
        out = self.scratch / "out"
        shutil.rmtree(out, ignore_errors=True)
        if with_former:
            shutil.copytree(self.scratch / "former", out)
        else:
            out.mkdir()
        return out

    def operations(self, with_former):
        out, log = self.fresh(with_former), self.scratch / "log"
        log.unlink(missing_ok=True)
        run(self.program, self.command.new, out, self.fault(out, FAULT_LOG=str(log)))
        return [line.split(" ", 1)[1] for line in log.read_text().splitlines()]

    def fault(self, out, **more):
        return {"LD_PRELOAD": str(self.library), "FAULT_BELOW": str(out), **more}

    def tell(self, what, where, seen):
        self.broken += 1
        print(f"{self.command.name}: {where}: {what}: {seen}", flush=True)

    def try_one(self, at, with_former, fault, name):
        self.runs += 1
        where = f"{name} at operation {at}, {'with' if with_former else 'without'} a former output"
        out = self.fresh(with_former)
        done = run(self.program, self.command.new, out, self.fault(out, FAULT_AT=str(at), **fault))
        files, hidden = state_of(out)
        allowed = [self.former] if with_former else [{}]
        killed = done.returncode == -signal.SIGKILL
        of_both = all(files[f] in (self.former.get(f), self.whole.get(f)) for f in files)
        if not killed and done.returncode not in (0, 1, 2, 130):
            self.tell("exit code", where, done.returncode)
        if killed:
            # Some of several moves may be done; the next run does the others.
            if not of_both:
                self.tell("half a file", where, sorted(files))
        elif done.returncode == 0:
            if files != self.whole:
                self.tell("not whole after success", where, sorted(files))
        elif not (self.command.parts and of_both) and files not in allowed + [self.whole]:
            self.tell("neither absent, former nor whole", where, sorted(files))
        if done.returncode == 130 and files == self.whole:
            self.tell("it says that it was interrupted", where, done.stderr)
        if hidden and not killed:
            self.tell("hidden files", where, hidden)
        again = run(self.program, self.command.new, out)
        files, hidden = state_of(out)
        if again.returncode != 0 or files != self.whole or hidden:
            self.tell("after one more run", where,
                      (again.returncode, again.stderr, sorted(files), hidden))

    def all(self, every, each, names, part):
        faults = [({"FAULT_ERROR": str(e)}, errno.errorcode[e]) for e in ERRORS]
        faults += [({"FAULT_SIGNAL": str(int(s))}, s.name) for s in SIGNALS]
        faults = [fault for fault in faults if not names or fault[1] in names]
        total, begin = 0, time.monotonic()
        for with_former in (False, True):
            operations = self.operations(with_former)
            total += len(operations)
            chosen = range(1, len(operations) + 1)
            if not every and not each:
                # The operations around the decision, with a fault that changes from one to the next
                moves = [i for i, o in enumerate(operations, 1) if o.startswith("rename")]
                chosen = sorted({2, *moves[-3:], *(i + 1 for i in moves[-1:])})
            for n, at in list(enumerate(chosen))[part[0] - 1::part[1]]:
                step = 1 if each else 3
                for fault, name in faults if every else [faults[(2 + n * step) % len(faults)]]:
                    self.try_one(at, with_former, fault, name)
        print(f"{self.command.name}: {total} operations, {self.runs} runs with a fault, "
              f"{self.broken} broken promises, in {time.monotonic() - begin:.0f} s", flush=True)
        return self.broken


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--only", default="render,head", help="commands: render,head,batch,shapes,fit")
    parser.add_argument("--part", default="1/1", type=lambda text: [int(number) for number in text.split("/")])
    parser.add_argument("--faults", default="", help="such as ENOSPC,SIGKILL; default: all")
    arguments = parser.parse_args()
    broken = 0
    with tempfile.TemporaryDirectory() as base:
        for command in commands(pathlib.Path(base)):
            if command.name not in arguments.only.split(","):
                continue
            scratch = pathlib.Path(base) / command.name
            scratch.mkdir()
            broken += Loop(arguments.program.resolve(), arguments.library.resolve(), command,
                           scratch).all(arguments.all, arguments.each, arguments.faults, arguments.part)
    sys.exit(1 if broken else 0)


main()
