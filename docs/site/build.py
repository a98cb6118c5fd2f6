#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""README.md and the pages of docs/ as a folder of HTML that opens from disk.

    build.py TREE OUT

No script, no network address that is loaded: a browser reads OUT/index.html as it lies there. What
leads where stands in docs/index.md: its headings are the groups of the menu, the links in its tables
the pages. Markdown is read by markdown-it-py (CommonMark and tables), as GitHub reads it.

Nothing is written, one line for each finding, and the exit status is 1, when

  a link leads to no file, or to no heading of a page,
  a page of docs/ is not in docs/index.md, or is there twice,
  a page has no heading of the first level, or more than one.

Mermaid's drawings are shown as their source: drawing them takes a script.
OUT is replaced as a whole. What is there and was not made by this program is refused (status 2);
where OUT cannot be written, the status is 3.
"""
import html
import pathlib
import posixpath
import re
import shutil
import string
import sys
import tempfile
import urllib.parse

from markdown_it import MarkdownIt

INDEX = "docs/index.md"
HOME = "README.md"
MADE_HERE = ".made-by-floorproof-docs"
DRAWING = ("A drawing in Mermaid's notation: <code>a --&gt; b</code> is an arrow from a to b, "
           "<code>&amp;</code> is &ldquo;and&rdquo;.")
PAGE = string.Template("""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<link rel="stylesheet" href="style.css">
</head>
<body>
<input type="checkbox" id="menu">
<header><a href="index.html">Floorproof</a><label for="menu">Menu</label></header>
<nav>
$menu
</nav>
$contents
<main>
$body
<footer>$steps<p>Made from $source.</p></footer>
</main>
</body>
</html>
""")


def slug(text):
    """A heading's anchor, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")


def text_of(inline):
    return "".join(child.content if child.type in ("text", "code_inline") else
                   " " if child.type == "softbreak" else "" for child in inline.children)


def is_outside(address):
    return bool(re.match(r"[a-z][a-z0-9+.-]*:", address))


class Page:
    """One Markdown file: its tokens, and the anchors of its headings."""

    def __init__(self, markdown, tree, source):
        self.source = source
        self.tokens = markdown.parse((tree / source).read_text(encoding="utf-8"))
        self.headings = []  # (level, anchor, text)
        taken = {}
        for token, inline in zip(self.tokens, self.tokens[1:]):
            if token.type == "heading_open":
                text = text_of(inline)
                anchor = slug(text)
                taken[anchor] = taken.get(anchor, -1) + 1
                anchor += f"-{taken[anchor]}" if taken[anchor] else ""
                token.attrSet("id", anchor)
                self.headings.append((int(token.tag[1]), anchor, text))
        self.titles = [text for level, _, text in self.headings if level == 1]
        self.anchors = {anchor for _, anchor, _ in self.headings}

    @property
    def file(self):
        name = pathlib.PurePosixPath(self.source)
        if self.source in (HOME, INDEX):
            return {HOME: "index.html", INDEX: "contents.html"}[self.source]
        return name.stem.lower() + ".html"

    def links(self):
        """(line, token, attribute) of each link and picture."""
        for token in self.tokens:
            for child in token.children or ():
                for kind, attribute in (("link_open", "href"), ("image", "src")):
                    if child.type == kind:
                        yield token.map[0] + 1, child, attribute


def groups_of(index):
    """[(heading, [source])] by the index's headings and the links in its tables."""
    groups = []
    in_table = False
    for token, following in zip(index.tokens, index.tokens[1:]):
        if token.type == "heading_open" and token.tag == "h2":
            groups.append((text_of(following), []))
        in_table = token.type == "table_open" or in_table and token.type != "table_close"
        for child in token.children or () if in_table else ():
            if child.type == "link_open" and groups:
                address = child.attrGet("href")
                if "#" not in address and address.endswith(".md"):
                    groups[-1][1].append(posixpath.normpath(posixpath.join("docs", address)))
    return groups


class Site:
    def __init__(self, tree):
        self.tree = tree
        self.markdown = MarkdownIt("commonmark").enable("table")
        self.markdown.add_render_rule("fence", render_fence)
        self.markdown.add_render_rule("table_open", lambda *_: '<div class="table"><table>\n')
        self.markdown.add_render_rule("table_close", lambda *_: "</table></div>\n")
        index = self.page(INDEX)
        self.groups = groups_of(index)
        self.order = [source for _, sources in self.groups for source in sources]
        self.findings = self.misplaced()
        self.pages = {source: self.page(source) for source in dict.fromkeys(self.order)
                      if (tree / source).is_file()}
        self.pages[INDEX] = index
        self.files = set()  # that pages lead to, and no page
        for page in self.pages.values():
            if len(page.titles) != 1:
                self.findings.append(f"{page.source}: {len(page.titles)} headings of the first level")
            for line, token, attribute in page.links():
                self.turn(page, line, token, attribute)

    def page(self, source):
        return Page(self.markdown, self.tree, source)

    def misplaced(self):
        there = {path.relative_to(self.tree).as_posix() for path in (self.tree / "docs").glob("*.md")}
        lost = sorted((there | {HOME}) - set(self.order) - {INDEX})
        twice = sorted({source for source in self.order if self.order.count(source) > 1})
        return ([f"{INDEX}: has no link to {source} in its tables" for source in lost] +
                [f"{INDEX}: has two links to {source} in its tables" for source in twice])

    def turn(self, page, line, token, attribute):
        """Makes a link lead to what the site holds, or finds that it leads nowhere."""
        address = token.attrGet(attribute)
        if is_outside(address):
            return
        path, _, anchor = urllib.parse.unquote(address).partition("#")
        folder = posixpath.dirname(page.source)
        source = posixpath.normpath(posixpath.join(folder, path)) if path else page.source
        target = self.pages.get(source)
        if target is None and (source.startswith("..") or not (self.tree / source).is_file()):
            self.findings.append(f"{page.source}:{line}: {address}: there is no {source}")
        elif target is None:
            self.files.add(source)
            token.attrSet(attribute, "files/" + urllib.parse.quote(source))
        elif anchor and anchor not in target.anchors:
            self.findings.append(f"{page.source}:{line}: {address}: {source} has no such heading")
        else:
            token.attrSet(attribute, (target.file if path else "") + (f"#{anchor}" if anchor else ""))

    def menu(self, here):
        """All pages by group; the group of the page where the reader is stands open."""
        lines = [f'<p><a href="{self.pages[INDEX].file}">All pages, and what they answer</a></p>']
        for heading, sources in self.groups:
            is_open = " open" if here.source in sources else ""
            lines.append(f"<details{is_open}><summary>{html.escape(heading)}</summary>\n<ul>")
            for source in sources:
                page = self.pages[source]
                mark = ' aria-current="page"' if page is here else ""
                lines.append(f'<li><a href="{page.file}"{mark}>{html.escape(page.titles[0])}</a></li>')
            lines.append("</ul></details>")
        return "\n".join(lines)

    def steps(self, page):
        """Links to the pages before and after."""
        if page.source not in self.order:
            return ""
        at = self.order.index(page.source)
        beside = [("Before", at - 1), ("Next", at + 1)]
        links = [f'<a href="{self.pages[self.order[i]].file}">{word}: '
                 f"{html.escape(self.pages[self.order[i]].titles[0])}</a>"
                 for word, i in beside if 0 <= i < len(self.order)]
        return f'<p class="steps">{" ".join(links)}</p>'

    def write(self, out):
        for page in self.pages.values():
            title = page.titles[0] if page.source == HOME else f"{page.titles[0]} - Floorproof"
            body = self.markdown.renderer.render(page.tokens, self.markdown.options, {})
            (out / page.file).write_text(PAGE.substitute(
                title=html.escape(title), menu=self.menu(page), contents=contents(page), body=body,
                steps=self.steps(page), source=page.source), encoding="utf-8")
        for source in sorted(self.files):
            (out / "files" / source).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(self.tree / source, out / "files" / source)
        shutil.copyfile(pathlib.Path(__file__).with_name("style.css"), out / "style.css")
        (out / MADE_HERE).touch()


def contents(page):
    """The page's headings: beside the text, or behind a word where there is no room."""
    items = [f'<li class="h{level}"><a href="#{anchor}">{html.escape(text)}</a></li>'
             for level, anchor, text in page.headings if level in (2, 3)]
    if not items:
        return ""
    return ('<input type="checkbox" id="contents">\n<aside><label for="contents">On this page</label>'
            "\n<ul>\n" + "\n".join(items) + "\n</ul></aside>")


def render_fence(_, tokens, at, *__):
    code = f"<pre><code>{html.escape(tokens[at].content)}</code></pre>\n"
    if tokens[at].info.strip() == "mermaid":
        return f"<figure><figcaption>{DRAWING}</figcaption>{code}</figure>\n"
    return code


def replace(out, write):
    """Writes a folder beside `out`, and puts it in its place when it is whole."""
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=out.parent, prefix=f".{out.name}.") as beside:
        whole = pathlib.Path(beside) / "site"
        whole.mkdir()
        write(whole)
        if out.exists():
            out.rename(pathlib.Path(beside) / "old")
        whole.rename(out)


def main():
    tree, out = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    if out.exists() and not (out / MADE_HERE).is_file() and (not out.is_dir() or any(out.iterdir())):
        print(f"floorproof: {out} is there and no pages of ours; it stays", file=sys.stderr)
        return 2
    site = Site(tree)
    if site.findings:
        print("\n".join(site.findings), file=sys.stderr)
        return 1
    try:
        replace(out, site.write)
    except OSError as error:
        print(f"floorproof: {out}: {error.strerror}", file=sys.stderr)
        return 3
    print(f"{len(site.pages)} pages; open {out / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
