#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures whether every named person can play every action unit, and makes docs/validation/people.md of it.

    tools/docs/people_page.py measure [NAME...] --program build/risorius   the people of model 2, or those who are named
    tools/docs/people_page.py                                              writes the page
    tools/docs/people_page.py --check                                      ends with 1 when the page is another one

A person takes about a minute of one core. Each is made by `risorius head`, and `risorius evaluate --facs` brings every action unit to
rest at intensity 1. docs/validation/people/measured.json keeps the numbers, and a person who is in it is measured again only by name. What a face recogniser
makes of pictures of one person is kept in docs/validation/people/same_person.json.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "validation" / "people.md"
MEASURED = ROOT / "docs" / "validation" / "people" / "measured.json"
# Distances that a face recogniser finds between the neutral picture of a person and other pictures of the same person. The recogniser
# is not part of the project, so that these numbers are not measured again here.
SAME = ROOT / "docs" / "validation" / "people" / "same_person.json"
# What viewers said of pictures
VIEWERS = ROOT / "docs" / "validation" / "people" / "viewers.json"
# The units whose gains docs/validation/faces.md tells of three heads
UNITS = [f"AU{n}" for n in (1, 2, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 20, 22, 23, 24, 25, 26, 27, 28, 43, 45)]
LEAST, MOST = 0.8, 1.25
ADULT = "adult"
# Key, limit, factor to the unit of the page; the limits are those of the certificate of blend shapes
MEASURES = [("volume_change", 0.02, 100), ("lip_depth_mm", 0.3, 1), ("eye_depth_mm", 0.3, 1)]


def people():
    """The adult, and the people of model 2, with sex, age and ancestry."""
    out = {ADULT: None}
    for file in sorted((ROOT / "models" / "identities").glob("*.json")):
        person = json.loads(file.read_text(encoding="utf-8"))
        if person.get("model") == 2:
            out[file.stem] = person
    return out


def told_by(command):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(word) for word in command)}: {done.stderr.decode()}")
    return json.loads(done.stdout)


def measured(name, program, calibrate):
    with tempfile.TemporaryDirectory() as folder:
        head = pathlib.Path(folder) / name
        rig = ROOT / "rigs" / "adult" / "rig.json"
        if name != ADULT:
            told_by([program, "head", "--identity", name, "-o", head, "--json"] + (["--calibrate"] if calibrate else []))
            rig = head / "rig.json"
        units = told_by([program, "evaluate", rig, "--facs", "--no-steps", "--json"])["units"]
    worst = {}
    for key, _, _ in MEASURES:
        value, unit = max((abs(unit[key]), unit["unit"]) for unit in units)
        worst[key] = {"value": round(value, 5), "unit": unit}
    return {"gains": {unit["unit"]: round(unit["gain"], 3) for unit in units},
            "inverted": {unit["unit"]: unit["inverted_tets"] for unit in units if unit["inverted_tets"] > 0},
            "unsettled": [unit["unit"] for unit in units if not unit["in_equilibrium"]],
            "worst": worst}


def read():
    return json.loads(MEASURED.read_text(encoding="utf-8")) if MEASURED.exists() else {}


def measure(names, program, calibrate):
    known = people()
    for name in names:
        if name not in known:
            sys.exit(f"people: expected one of {', '.join(known)}, found \"{name}\"")
    for name in names or [name for name in known if name not in read()]:
        print(name, flush=True)
        numbers = measured(name, program, calibrate)
        kept = read()
        kept[name] = numbers
        MEASURED.parent.mkdir(exist_ok=True)
        partial = MEASURED.with_suffix(".partial")
        partial.write_text(json.dumps(dict(sorted(kept.items())), indent=1) + "\n", encoding="utf-8")
        os.replace(partial, MEASURED)


def outside(gains):
    return {unit: gain for unit, gain in gains.items() if unit in UNITS and not LEAST <= round(gain, 2) <= MOST}


def beyond(numbers):
    """Names of the measures that are beyond their limits."""
    return [key for key, limit, _ in MEASURES if numbers["worst"][key]["value"] > limit]


def cell(numbers, key, limit, factor):
    one = numbers["worst"][key]
    text = f"{factor * one['value']:.2f}"
    return f"**{text}** ({one['unit']})" if one["value"] > limit else text


def row(name, person, numbers):
    gains = {unit: gain for unit, gain in numbers["gains"].items() if unit in UNITS}
    least, most = min(gains, key=gains.get), max(gains, key=gains.get)
    who = ""
    if person:
        sex = "woman" if person["sex"] < 0 else "man"
        who = f"{sex}, {person['age']:.0f}, {next(iter(person['ancestry'])).replace('_', ' ')}"
    inverted = sum(numbers["inverted"].values())
    cells = [name, who, f"{len(gains) - len(outside(gains))} of {len(gains)}", f"{gains[least]:.2f} ({least}), {gains[most]:.2f} ({most})",
             f"**{inverted}** ({', '.join(numbers['inverted'])})" if inverted else "0"]
    cells += [cell(numbers, *measure) for measure in MEASURES]
    cells.append(", ".join(numbers["unsettled"]) or "-")
    return "| " + " | ".join(cells) + " |"


def same_person():
    """The section on pictures of one person."""
    same = json.loads(SAME.read_text(encoding="utf-8"))
    names, limit = list(same["distances"]), same["limit"]
    pictures = same["pictures"]
    values = [value for name in names for value in same["distances"][name]]
    below = sum(value < limit for value in values)
    lines = [
        "## The same person",
        "",
        "A face recogniser is to find that pictures of one person show one person. It describes a face by 128 numbers; its own limit for another "
        f"person is a distance of 0.6, and here it is {limit}. The pictures are of {len(names)} people, from the front, 512 pixels wide: neutral, with seven "
        "expressions at half and at full intensity, with the head turned by 20 degrees to both sides, and in two other lights. The table has the "
        "distance of each picture from the neutral one.",
        "",
        f"{below} of {len(values)} pictures are below {limit}. Of all pairs of pictures of one person, {same['pairs_below_percent']} % are.",
        "",
        "| picture | " + " | ".join(names) + " |",
        "|---|" + "---|" * len(names),
    ]
    for k, picture in enumerate(pictures):
        cells = [same["distances"][name][k] for name in names]
        lines.append(f"| {picture} | " + " | ".join(f"**{c:.2f}**" if c >= limit else f"{c:.2f}" for c in cells) + " |")
    return lines + [""]


def viewers():
    """The section on what viewers say who see pictures only."""
    told = json.loads(VIEWERS.read_text(encoding="utf-8"))
    lines = [
        "## What viewers say",
        "",
        "A viewer who saw only pictures, in a drawn order, was asked for sex and age, how many people there are, and who is a copy of whom. The viewer "
        "was a program that describes pictures, not a person: the test with people is still to be made.",
        "",
        "| pictures | sex as asked for | mean error of the age, years | different people | copies |",
        "|---|---|---|---|---|",
    ]
    for key, name in (("drawn", "seeds 1 to 24"), ("named", "the named people")):
        one = told[key]
        lines.append(f"| {name} | {one['sex_as_asked']} of {one['pictures']} | {one['age_error_years']} | {one['persons']} | {one['copies']} |")
    pairs = told["pairs"]
    lines += [
        "",
        f"Four such viewers first saw 10 pairs each, one picture of a person as drawn first, with a shaven head, and one of a named person of now, and chose the more "
        f"believable one: {pairs['now_preferred']} of {pairs['asked']} times that of now; 9 of 10 is the aim. Two viewers saw the hair before it was last mended, two "
        "after: 5 of 20 times each. For those of now they named skin, folds, brows and character; against them, hair like a wig of ribbons, mouths "
        "that are pinched or stand out, square jaws, and beards like patches. The heads of then look like wax, they said, and like one person. Hair and proportions were changed after that. Two more viewers saw 20 new pairs, and chose the person of now 4 times (ravi, lakshmi, yuki, sofia): long hair is still a stiff wig with chopped ends for them, short hair a cap or a tint, beards are stamped on, and lines are carved.",
        "",
        "Upper row: eight people that the program drew at first. Lower row: the people of seeds 1 to 8.",
        "",
        "![Eight people as they were drawn first, and eight people of now](people/comparison.png)",
        "",
    ]
    return lines


def page():
    known, kept = people(), read()
    names = [name for name in known if name in kept]
    drawn = [name for name in names if name != ADULT]
    whole = [name for name in drawn
             if not outside(kept[name]["gains"]) and not beyond(kept[name]) and not kept[name]["inverted"]]
    units = max((len(kept[name]["gains"]) for name in names), default=0)
    lines = [
        "# People",
        "",
        "This page says whether every person of `models/identities` with model 2 can play every action unit. `tools/docs/people_page.py` makes it "
        "from what `tools/docs/people_page.py measure` has found with `risorius head` and `risorius evaluate --facs`.",
        "",
        f"{len(drawn)} of {len(known) - 1} people were measured, with {units} action units each, both sides together, at intensity 1. "
        f"{len(whole)} of them are within all limits of the table. Their muscles have the strengths and gains of the adult.",
        "",
        f"*In range* counts the {len(UNITS)} units of [Faces](faces.md#action-units) whose gain is between {LEAST} and {MOST}: how far landmarks "
        "go of the way that the table of units asks for. The other columns are the worst values of all units, and where a limit is exceeded, "
        "the unit. *Inverted* counts tetrahedra of the tissue that are turned inside out. The limits are those of the "
        "[certificate](../formats/shapes.md#certificate-risorius-shapes-certificate) of blend shapes: the volume of the tissue may change by 2 %; one lip "
        "may reach into the other, and skin into an eye, 0.3 mm deeper than at rest. *Unsettled* names what did not come to rest.",
        "",
        "| person | | in range | least and largest gain | inverted | volume, % | lip in lip, mm | skin in eye, mm | unsettled |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    lines += [row(name, known[name], kept[name]) for name in names]
    lines.append("")
    missed = {}
    for name in names:
        for unit, gain in outside(kept[name]["gains"]).items():
            missed.setdefault(unit, []).append(f"{name} {gain:.2f}")
    if missed:
        lines += ["Units out of range:", "", "| unit | people |", "|---|---|"]
        lines += [f"| {unit} | {', '.join(missed[unit])} |" for unit in UNITS if unit in missed]
        lines.append("")
    lines += same_person() + viewers()
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="*", help="measure, and then names of people")
    parser.add_argument("--check", action="store_true", help="compare the page with the numbers")
    parser.add_argument("--program", default=str(ROOT / "build" / "risorius"), help="the program risorius")
    parser.add_argument("--calibrate", action="store_true", help="with strengths of muscles that are found for each head")
    arguments = parser.parse_args()
    if arguments.what[:1] == ["measure"]:
        return measure(arguments.what[1:], arguments.program, arguments.calibrate)
    if arguments.what:
        sys.exit(f"people_page.py: expected measure or nothing, found \"{arguments.what[0]}\"")
    if arguments.check:
        sys.exit(0 if PAGE.read_text(encoding="utf-8") == page() else 1)
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
