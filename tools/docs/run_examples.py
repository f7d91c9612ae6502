#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the examples of the manual: the shell commands of README.md and docs/, page by page, each page in a scratch copy.

    tools/docs/run_examples.py                        every page
    tools/docs/run_examples.py docs/getting-started.md --verbose
    tools/docs/run_examples.py --list                 what would run, and what is skipped and why

A block fenced with ```bash runs from the root of the repository, the blocks of a page one after another. Invisible
comments on the line before a block change that:

    <!-- test: skip REASON -->        the block does not run
    <!-- test: fails CODE -->         its last command has to end with this exit code
    <!-- test: append --size 96x96 -->  the text is appended to every build/risorius command of the block
    <!-- file: mine/script.json -->   before a ```json, ```text or ```python block: its text is saved there first

Exit code 1 when a command fails, 2 when a comment is not understood.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^```(\w*)\s*$")
COMMENT = re.compile(r"^<!--\s*(test|file):\s*(.*?)\s*-->\s*$")


class Block:
    def __init__(self, page, line, language, lines, comments):
        self.page, self.line, self.language, self.text = page, line, language, "\n".join(lines) + "\n"
        self.skip = self.append = self.file = None
        self.code = 0
        for kind, value in comments:
            word, _, rest = value.partition(" ")
            if kind == "file" and value and not value.startswith("/") and ".." not in value:
                self.file = value
            elif kind == "test" and word == "skip" and rest:
                self.skip = rest
            elif kind == "test" and word == "append" and rest:
                self.append = rest
            elif kind == "test" and word == "fails" and rest.isdigit():
                self.code = int(rest)
            else:
                sys.exit(f"{page}:{line}: expected skip REASON, fails CODE, append TEXT or a relative file, found \"{value}\"")

    def place(self):
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def blocks(page):
    """The fenced blocks of a page, each with the comments on the lines directly before it."""
    found, comments, inside = [], [], None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if inside is not None:
            if line.strip() == "```":
                found.append(Block(page, inside[0], inside[1], inside[2], inside[3]))
                inside, comments = None, []
            else:
                inside[2].append(line)
        elif match := FENCE.match(line):
            inside = (number, match[1], [], comments)
        elif match := COMMENT.match(line):
            comments.append((match[1], match[2]))
        elif line.strip():
            comments = []
    if inside is not None:
        sys.exit(f"{page}:{inside[0]}: a block without an end")
    return found


def with_appended(text, extra):
    """The text with `extra` behind every command of build/risorius; a backslash at a line's end continues a command."""
    out = []
    for line in text.replace("\\\n", " ").splitlines():
        if extra and re.search(r"(^|\s)build/risorius\s", line):
            command, hash_, rest = line.partition(" #")
            line = f"{command} {extra}{hash_}{rest}"
        out.append(line)
    return "\n".join(out) + "\n"


def scratch_copy(folder, program):
    for entry in ROOT.iterdir():
        if entry.name in (".git", "out", "mine") or entry.name.startswith("build"):
            continue
        if entry.name in ("samples", "rigs", "models"):
            shutil.copytree(entry, folder / entry.name)
        else:
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    for built in program.parent.iterdir():
        (folder / "build" / built.name).symlink_to(built)


def run_page(page, program, verbose):
    """What is to be printed, blocks that failed, blocks that ran, blocks that were skipped."""
    report, failures, ran, skipped = [], 0, 0, []
    with tempfile.TemporaryDirectory(prefix="risorius-docs-") as name:
        folder = pathlib.Path(name)
        scratch_copy(folder, program)
        for block in blocks(page):
            if block.file:
                target = folder / block.file
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(block.text)
            if block.language != "bash":
                continue
            if block.skip:
                skipped.append(f"{block.place()}: {block.skip}")
                continue
            started = time.monotonic()
            script = "set -euo pipefail\n" + with_appended(block.text, block.append)
            done = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "LC_ALL": "C.UTF-8"})
            ran += 1
            good = done.returncode == block.code
            if verbose or not good:
                report.append((done.stdout + done.stderr).rstrip("\n"))
            report.append(f"{'ok  ' if good else 'FAIL'} {time.monotonic() - started:6.1f} s  {block.place()}")
            if not good:
                report.append(f"     exit code {done.returncode} where {block.code} was expected, of:\n{block.text}")
                failures += 1
                break  # what follows on the page needs it
    return "\n".join(report), failures, ran, skipped


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", type=pathlib.Path, help="README.md and docs/**/*.md when none is given")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/risorius")
    parser.add_argument("--jobs", type=int, default=1, help="pages at a time")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--verbose", action="store_true", help="show what the commands print")
    options = parser.parse_args()
    pages = [page.resolve() for page in options.pages] or [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]

    if options.list:
        for block in (b for page in pages for b in blocks(page) if b.language == "bash"):
            print(f"{block.place()}: {'skipped: ' + block.skip if block.skip else block.text.splitlines()[0]}")
        return 0
    if not options.program.is_file():
        sys.exit(f"{options.program} is not there: build it, or name it with --program")
    failures, ran, skipped = 0, 0, []
    with_commands = [page for page in pages if any(block.language == "bash" for block in blocks(page))]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for report, *counts in pool.map(lambda page: run_page(page, options.program.resolve(), options.verbose), with_commands):
            if report:
                print(report, flush=True)
            failures, ran, skipped = failures + counts[0], ran + counts[1], skipped + counts[2]
    for line in skipped:
        print(f"skipped {line}")
    print(f"{ran} blocks ran, {failures} failed, {len(skipped)} skipped")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
