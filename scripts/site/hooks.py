# SPDX-License-Identifier: MIT
"""What MkDocs makes a site of: every document of the repository, at its own path, so that links
work as they do in the repository. A link to a source file leads to a page with that file's text."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from mkdocs.structure.files import File, Files
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_for_filename
from pygments.util import ClassNotFound

ROOT = Path(__file__).resolve().parents[2]
# Shown or opened by a browser: copied as they are.
COPIED = {".svg", ".png", ".gif", ".html", ".css", ".js"}
LINK = re.compile(r"(?<=\]\()([^)\s#]+)(#[^)\s]*)?(?=\))")
STYLE = """
.wy-nav-content { max-width: 1100px; }
img { background: #fff; }
table { display: block; overflow-x: auto; }
"""


def documents() -> list[str]:
    listed = subprocess.run(
        ["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return listed.stdout.splitlines()


def target_of(document: str, link: str) -> str | None:
    """The path in the repository that a link of a document means; None if it leaves it."""
    if re.match(r"\w+:", link):
        return None
    path = os.path.normpath(os.path.join(os.path.dirname(document), unquote(link)))
    return None if path.startswith("..") else path


def linked(document: str) -> set[str]:
    text = (ROOT / document).read_text(encoding="utf-8")
    found = [link for link, _ in LINK.findall(text)] + re.findall(r'<img src="([^"]+)"', text)
    return {path for link in found if (path := target_of(document, link))}


def page_of(path: str) -> str:
    """The page that shows what a link leads to."""
    here = ROOT / path
    if here.is_dir():
        return f"{path}/README.md" if (here / "README.md").exists() else f"{path}/index.source.md"
    if here.suffix == ".md" or here.suffix in COPIED or not here.exists():
        return path
    return f"{path}.source.md"


def text_of_source(path: str) -> str:
    here = ROOT / path
    if here.is_dir():
        names = sorted(
            entry.name for entry in here.iterdir() if not entry.name.startswith((".", "_"))
        )
        return f"# {path}\n\n" + "".join(f"* `{name}`\n" for name in names)
    try:
        language = get_lexer_for_filename(path).aliases[0]
        text = here.read_text(encoding="utf-8")
    except (ClassNotFound, UnicodeDecodeError):
        return f"# {path}\n\nA file of {here.stat().st_size} bytes; it is in the repository.\n"
    fence = "`" * 6
    return f"# {path}\n\n{fence}{language}\n{text}{fence}\n"


def on_files(files: Files, config: Any) -> Files:
    """Every document and what the documents show, instead of the folder that MkDocs read."""
    ours = [file for file in files if file.src_dir != config.docs_dir]  # the theme's
    add = dict[str, File]()

    def copy(path: str) -> None:
        add[path] = File(path, str(ROOT), config.site_dir, use_directory_urls=False)

    pages = documents()
    for path in pages:
        copy(path)
    for path in sorted(set().union(*map(linked, pages))):
        page = page_of(path)
        if page == path and (ROOT / path).is_file():
            copy(path)
        elif page.endswith(".source.md") and (ROOT / path).exists():
            add[page] = File.generated(config, page, content=text_of_source(path))
            add[page].dest_uri = page.removesuffix(".md") + ".html"
    for path in sorted((ROOT / "course").rglob("*")):
        if path.suffix in COPIED and path.parent.name in {"pictures", "slides"}:
            copy(str(path.relative_to(ROOT)))
    style = HtmlFormatter().get_style_defs(".codehilite") + STYLE
    add["site.css"] = File.generated(config, "site.css", content=style)
    return Files([*ours, *add.values()])


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Links to sources lead to their pages; Markdown is read inside of <details>, too."""
    document = page.file.src_uri

    def to_page(found: re.Match[str]) -> str:
        path = target_of(document, found[1])
        if path is None or page_of(path) == path:
            return found[0]
        relative = os.path.relpath(page_of(path), os.path.dirname(document) or ".")
        return relative + (found[2] or "")

    if document.endswith(".source.md"):
        return markdown
    return LINK.sub(to_page, markdown).replace("<details>", '<details markdown="1">')


def github_anchor(heading: str, separator: str) -> str:
    """As GitHub makes it, so that one link serves both."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", separator)


def on_config(config: Any) -> Any:
    config.mdx_configs.setdefault("toc", {})["slugify"] = github_anchor
    return config
