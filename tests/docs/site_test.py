#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/site/build.py on small trees, each broken in one way, and on the tree itself.

    site_test.py TREE

Exit status 77 where no python3 of the PATH has markdown-it-py: the pages cannot be made there.
"""
import contextlib
import html.parser
import io
import os
import pathlib
import shutil
import sys
import tempfile
import unittest
import urllib.parse

sys.dont_write_bytecode = True
TREE = pathlib.Path(sys.argv.pop()).resolve()
sys.path.insert(0, str(TREE / "docs/site"))
try:
    import build
except ModuleNotFoundError:  # the system's own Python may have it; it comes with apt
    own = shutil.which("python3", path="/usr/bin")
    if own and not os.path.samefile(own, sys.executable):
        os.execv(own, [own, __file__, str(TREE)])
    print("skipped: python3 has no markdown_it (Debian's python3-markdown-it)")
    sys.exit(77)

SMALL = {
    "README.md": "# Small\n\n[all](docs/index.md), [a](docs/a.md#what-is-it), [text](LICENSE)\n",
    "LICENSE": "mine",
    "docs/index.md": "# Documentation\n\n## Start\n\n| page | what |\n|---|---|\n"
                     "| [Small](../README.md) | it |\n\n## More\n\n| page | what |\n|---|---|\n"
                     "| [A](a.md) | it, or [twice](a.md#twice-1) |\n",
    "docs/a.md": "# A `b`\n\n## What is it?\n\n## Twice\n\n## Twice\n\n[here](#a-b) "
                 "[there](https://example.org) ![drawn](img/a.png)\n\n"
                 "```mermaid\nflowchart TD\n  a --> b\n```\n",
    "docs/img/a.png": "",
}


class Links(html.parser.HTMLParser):
    """The anchors of a page, its links, and what a browser would load for it."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loaded, self.tags = set(), [], [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.add(tag)
        self.anchors.add(attributes.get("id"))
        if tag == "a":
            self.links.append(attributes["href"])
        self.loaded += [attributes[key] for key in ("src", "href") if key in attributes and tag != "a"]


class Small(unittest.TestCase):
    def made(self, changes=()):
        """What build.py says of the small tree, and its status; the site lies in self.out."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree, self.out = (pathlib.Path(folder.name) / name for name in ("tree", "out"))
        for name, text in {**SMALL, **dict(changes)}.items():
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            (self.tree / name).write_text(text, encoding="utf-8")
        return self.again()

    def again(self):
        with contextlib.redirect_stderr(io.StringIO()) as said, \
                contextlib.redirect_stdout(io.StringIO()):
            sys.argv = ["build.py", str(self.tree), str(self.out)]
            status = build.main()
        return status, said.getvalue().strip()

    def refused(self, changes, line):
        self.assertEqual(self.made(changes), (1, line))
        self.assertFalse(self.out.exists(), "nothing is written")

    def test_links_lead_to_what_the_site_holds(self):
        self.assertEqual(self.made(), (0, ""))
        home, page = Links(self.out / "index.html"), Links(self.out / "a.html")
        for link in ("contents.html", "a.html#what-is-it", "files/LICENSE"):
            self.assertIn(link, home.links)
        for link in ("#a-b", "https://example.org"):
            self.assertIn(link, page.links)
        self.assertEqual((self.out / "files/LICENSE").read_text(), "mine")
        self.assertIn("files/docs/img/a.png", page.loaded)
        self.assertIn("a --&gt; b", (self.out / "a.html").read_text())

    def test_a_link_to_no_file(self):
        self.refused({"README.md": "# Small\n\ntwo\n\n[b](docs/b.md)\n"},
                     "README.md:5: docs/b.md: there is no docs/b.md")

    def test_a_link_to_no_heading(self):
        self.refused({"README.md": "# Small\n\n[a](docs/a.md#what-is-it-1)\n"},
                     "README.md:3: docs/a.md#what-is-it-1: docs/a.md has no such heading")

    def test_a_picture_that_is_not_there(self):
        self.refused({"README.md": "# Small\n\n![a](docs/img/b.png)\n"},
                     "README.md:3: docs/img/b.png: there is no docs/img/b.png")

    def test_a_link_out_of_the_tree(self):
        self.refused({"README.md": "# Small\n\n[a](../tree/LICENSE)\n"},
                     "README.md:3: ../tree/LICENSE: there is no ../tree/LICENSE")

    def test_a_page_that_the_index_forgets(self):
        self.refused({"docs/b.md": "# B\n"}, "docs/index.md: has no link to docs/b.md in its tables")

    def test_a_page_that_stands_twice(self):
        twice = SMALL["docs/index.md"] + "| [A](a.md) | again |\n"
        self.refused({"docs/index.md": twice}, "docs/index.md: has two links to docs/a.md in its tables")

    def test_a_page_with_two_titles(self):
        self.refused({"README.md": "# Small\n\n# Large\n"}, "README.md: 2 headings of the first level")

    def test_what_is_there_and_not_ours_stays(self):
        self.made()
        self.assertEqual(self.again(), (0, ""))
        (self.out / build.MADE_HERE).unlink()
        self.assertEqual(self.again(),
                         (2, f"floorproof: {self.out} is there and no pages of ours; it stays"))

    def test_a_page_that_is_gone_leaves_no_file(self):
        self.made()
        (self.out / "old.html").touch()
        self.again()
        self.assertFalse((self.out / "old.html").exists())


class Whole(unittest.TestCase):
    def test_every_link_of_the_site_leads_somewhere_and_nothing_is_loaded_from_elsewhere(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "out"
            with contextlib.redirect_stdout(io.StringIO()):
                sys.argv = ["build.py", str(TREE), str(out)]
                self.assertEqual(build.main(), 0)
            pages = {path.name: Links(path) for path in out.glob("*.html")}
            self.assertGreater(len(pages), 30)
            for name, page in pages.items():
                self.assertNotIn("script", page.tags, name)
                self.assertFalse([link for link in page.loaded if build.is_outside(link)], name)
                for link in page.loaded + page.links:
                    if build.is_outside(link):
                        continue
                    file, _, anchor = urllib.parse.unquote(link).partition("#")
                    self.assertTrue((out / (file or name)).is_file(), f"{name}: {link}")
                    if anchor:
                        self.assertIn(anchor, pages[file or name].anchors, f"{name}: {link}")


if __name__ == "__main__":
    unittest.main()
