#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks links: of every Markdown page of the repository, and with a folder given, of every HTML page of the built site.

    check_links.py                   README.md, CONTRIBUTING.md, docs/, samples/, rigs/, models/: files and headings exist
    check_links.py build/site        the same of the site: pages, pictures, anchors

Links to other servers are not followed. Exit code 1 when a link leads nowhere.
"""
import html.parser
import pathlib
import re
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"\]\(([^)\s]+)\)|^\[[^\]]+\]:\s+(\S+)", re.MULTILINE)
CODE = re.compile(r"^```.*?^```\s*?$|^    .*?$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
MADE_LATER = {ROOT / "docs/cli.md"}  # generated from --help


def slugs(page, cache={}):
    """The anchors of a Markdown page, as GitHub makes them of its headings."""
    if page not in cache:
        text = re.sub(r"^```.*?^```\s*?$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
        names, seen = set(), {}
        for heading in re.findall(r"^#+\s+(.*?)\s*$", text, re.MULTILINE):
            plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
            slug = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
            count = seen.get(slug, 0)
            seen[slug] = count + 1
            names.add(slug if not count else f"{slug}-{count}")
        names.update(re.findall(r'<a (?:id|name)="([^"]+)"', text))
        cache[page] = names
    return cache[page]


def markdown_pages():
    for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"):
        if (ROOT / name).is_file():
            yield ROOT / name
    for folder in ("docs", "samples", "rigs", "models"):
        yield from sorted((ROOT / folder).rglob("*.md"))


def broken_in_markdown(page):
    text = CODE.sub(lambda match: "\n" * match[0].count("\n"), page.read_text())
    for match in LINK.finditer(text):
        target = match[1] or match[2]
        if re.match(r"[a-z]+:", target):
            continue
        line = text[:match.start()].count("\n") + 1
        path, _, anchor = target.partition("#")
        aim = (page.parent / urllib.parse.unquote(path)).resolve() if path else page
        if aim in MADE_LATER and not aim.exists():
            continue
        if not aim.exists():
            yield f"{page.relative_to(ROOT)}:{line}: no such file: {target}"
        elif anchor and aim.suffix == ".md" and anchor not in slugs(aim):
            yield f"{page.relative_to(ROOT)}:{line}: no such heading: {target}"


class Links(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.targets = set(), []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.ids.add(value)
            if name in ("href", "src") and value and tag in ("a", "img", "script", "link"):
                self.targets.append(value)


def broken_in_site(site):
    pages = {page: Links(page.read_text(errors="replace")) for page in sorted(site.rglob("*.html"))
             if "api" not in page.relative_to(site).parts}
    for page, links in pages.items():
        for target in links.targets:
            if re.match(r"[a-z]+:|//", target) or page.name == "404.html":
                continue
            path, _, anchor = target.partition("#")
            aim = (page.parent / urllib.parse.unquote(path.partition("?")[0])).resolve() if path else page
            if aim.is_dir():
                aim = aim / "index.html"
            if not aim.exists():
                yield f"{page.relative_to(site)}: no such file: {target}"
            elif anchor and aim in pages and urllib.parse.unquote(anchor) not in pages[aim].ids:
                yield f"{page.relative_to(site)}: no such anchor: {target}"


def main():
    if len(sys.argv) > 1:
        broken = list(broken_in_site(pathlib.Path(sys.argv[1]).resolve()))
    else:
        broken = [line for page in markdown_pages() for line in broken_in_markdown(page)]
    print("\n".join(broken + [f"{len(broken)} broken links"] if broken else ["links: all lead somewhere"]))
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
