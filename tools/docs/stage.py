#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lays out what the site is built from: docs/ as it is, and below files/ whatever its pages link to outside of docs/.

    stage.py build/docs-source

mkdocs sees one folder only, while the pages of docs/, read in the repository, link to pictures of samples/ and to pages such
as rigs/README.md. Those are copied along and the links changed, so that both ways of reading work.
"""
import os
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
PAGES_BEYOND = (".md", ".png", ".json", ".csv", ".cff", ".tsv", ".txt")  # and files without an ending: LICENSE, Containerfile
LINK = re.compile(r"(\]\(|^\[[^\]]+\]:\s+)([^)\s]+)", re.MULTILINE)
FENCED = re.compile(r"(^```.*?^```\s*?$)", re.MULTILINE | re.DOTALL)
COMMENT = re.compile(r"^<!--\s*(?:test|file):.*?-->\n", re.MULTILINE)


def address(path):
    """Where a file of the repository lies in the staged tree."""
    if path.is_relative_to(DOCS):
        return path.relative_to(DOCS)
    return pathlib.Path("files") / path.relative_to(ROOT)


def shown(path):
    """Whether the site holds a copy of the file; sources are named but not copied."""
    return path.is_file() and path.is_relative_to(ROOT) and (path.suffix in PAGES_BEYOND or not path.suffix)


def stage(page, out, done, waiting):
    text = page.read_text()

    def changed(match):
        opening, target = match.groups()
        if re.match(r"[a-z]+:|#", target):
            return match[0]
        path, hash_, anchor = target.partition("#")
        aim = (page.parent / path).resolve()
        if aim.is_dir() and (aim / "README.md").is_file():
            aim = aim / "README.md"
        if not shown(aim):
            return match[0] if not aim.exists() else f"{opening}{os.path.relpath(pathlib.Path('files/sources.md'), address(page).parent)}"
        if aim not in done:
            waiting.append(aim)
        return f"{opening}{os.path.relpath(address(aim), address(page).parent)}{hash_}{anchor}"

    parts = FENCED.split(COMMENT.sub("", text))
    parts[::2] = [LINK.sub(changed, part) for part in parts[::2]]
    target = out / address(page)
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("".join(parts))


def check_menu():
    """Every page of docs/ has its place in the menu of the site, and the menu names no other."""
    named = set(re.findall(r"([\w./-]+\.md)\s*$", (ROOT / "tools/docs/mkdocs.yml").read_text(), re.MULTILINE))
    pages = {str(page.relative_to(DOCS)) for page in DOCS.rglob("*.md")} | {"cpp-api.md", "cli.md"}
    pages = {page for page in pages if not re.match(r"decisions/\d", page)}  # their index lists them
    complaints = [f"docs/{page} is missing in the menu (nav)" for page in sorted(pages - named)]
    complaints += [f"the menu (nav) names {page}, which is not in docs/" for page in sorted(named - pages)]
    if complaints:
        sys.exit("\n".join(f"tools/docs/mkdocs.yml: {line}" for line in complaints))


def main():
    out = pathlib.Path(sys.argv[1]).resolve()
    check_menu()
    shutil.rmtree(out, ignore_errors=True)
    waiting = [path for path in sorted(DOCS.rglob("*")) if path.is_file()]
    done = set()
    while waiting:
        path = waiting.pop()
        if path in done:
            continue
        done.add(path)
        if path.suffix == ".md":
            stage(path, out, done, waiting)
        else:
            target = out / address(path)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target)
    (out / "files").mkdir(exist_ok=True)
    (out / "files/sources.md").write_text("# Sources\n\nThis file is not part of the site. It lies in the repository, at the path that the link names.\n")
    (out / "cpp-api.md").write_text("# C++ API\n\n[The reference of all public headers](api/index.html), made by Doxygen.\n")
    (out / "api").mkdir(exist_ok=True)
    (out / "api/index.html").write_text("<p>This site was built without the C++ reference (tools/docs.sh --no-api).</p>\n")
    for extra in ("extra.css", "math.js"):
        shutil.copyfile(ROOT / "tools/docs" / extra, out / extra)
    katex = pathlib.Path("/usr/share/javascript/katex")
    for name in ("katex.min.css", "katex.min.js", "contrib/auto-render.js"):
        if (katex / name).is_file():
            (out / "katex" / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(katex / name, out / "katex" / name)
    shutil.copytree(katex / "fonts", out / "katex/fonts", ignore=shutil.ignore_patterns("*.ttf", "*.woff"))


if __name__ == "__main__":
    main()
