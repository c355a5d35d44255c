# SPDX-License-Identifier: MIT
"""Figures as files, and files as pictures of the page.

Letters in an SVG stay text: a third of the size of their outlines, sharp, and found by a search. So
the picture brings its font along, cut down to the letters in it.
"""

import base64
import io
import logging
import re
from collections.abc import Iterable
from functools import partial
from html import unescape
from pathlib import Path

from fontTools import subset
from markupsafe import Markup
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont
from PIL import Image

from octocell_report import style

ENDINGS = ("png", "svg")
_COLOURS = 256  # of a PNG, and half the size; with 128 rare reds become brown
_TAG = re.compile(r"<[^>]*>")
_LONE = re.compile(r"<g>(<(?:path|use)[^>]*/>|<text[^>]*>[^<]*</text>)</g>")  # groups of one
_SHORTER = (
    (r"\s+", " "),
    (r"(\.\d\d)\d+", r"\1"),  # a hundredth of a point
    (r' transform="rotate\(-?0 [^"]*"', ""),
    (r'<g id="[^"]*"', "<g"),
)


def write(figures: Iterable[tuple[str, Figure]], folder: Path) -> None:
    """Each as NAME.png and NAME.svg."""
    for name, figure in figures:
        _save(figure, folder / f"{name}.png")
        figure.set_layout_engine("none")  # the layout stands: to find it takes longer than to draw
        (folder / f"{name}.svg").write_text(svg(figure), encoding="utf-8")


def files_of(names: Iterable[str]) -> set[str]:
    """What write() may write of figures with these names."""
    return {f"{name}.{ending}" for name in names for ending in ENDINGS}


def drawn(names: Iterable[str], folder: Path) -> list[str]:
    """Those that had something to show, so that they lie in the folder."""
    return [name for name in names if (folder / f"{name}.png").exists()]


def _save(figure: Figure, path: Path) -> None:
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=style.DPI, pil_kwargs={"compress_level": 1})
    with Image.open(buffer) as image:
        # Not the fast octree, which makes one colour of white and of pale fills.
        image.convert("RGB").quantize(_COLOURS, Image.Quantize.MEDIANCUT).save(path)


def svg(figure: Figure) -> str:
    """Without what Matplotlib writes for people: date, names of groups, line breaks, digits."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg")
    text = re.sub(r"<metadata>.*?</metadata>|^.*?(?=<svg)", "", buffer.getvalue(), flags=re.DOTALL)
    text = re.sub(r">\s+<", "><", _TAG.sub(_shorter, text))
    while (fewer := _LONE.sub(r"\1", text)) != text:
        text = fewer
    fonts = f"<style>text{{white-space:pre}}{_fonts(text)}</style>"
    return text.replace("<defs>", f"<defs>{fonts}", 1)


def _shorter(tag: re.Match[str]) -> str:
    text = tag[0]
    for long, short in _SHORTER:
        text = re.sub(long, short, text)
    return text


def _fonts(svg: str) -> str:
    """The two weights of the font, with the letters of these pictures."""
    logging.getLogger("fontTools.subset").setLevel(logging.ERROR)
    letters = unescape(_TAG.sub("", svg))
    return "".join(_font(weight, letters) for weight in ("normal", "bold"))


def _font(weight: str, letters: str) -> str:
    options = subset.Options(flavor="woff", hinting=False, layout_features=[])
    subsetter, buffer = subset.Subsetter(options), io.BytesIO()
    path = findfont(FontProperties(family=style.FONT, weight=weight))
    with subset.load_font(path, options) as font:
        subsetter.populate(text=letters)
        subsetter.subset(font)
        subset.save_font(font, buffer, options)
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    source = f"url(data:font/woff;base64,{data})"
    return f"@font-face{{font-family:'{style.FONT}';font-weight:{weight};src:{source}}}"


class Gallery:
    """The pictures of a page: the font, and the looks of their parts, stand once in its style."""

    def __init__(self, folder: Path) -> None:
        self._letters: set[str] = set()
        self._looks: dict[str, str] = {}  # the name of a class, by what it says
        self._ids: dict[tuple[str, str], str] = {}  # the new one, by picture and what it was there
        self.pictures = {path.stem: self._picture(path) for path in sorted(folder.glob("*.svg"))}

    def _picture(self, path: Path) -> Markup:
        svg = re.sub("<style.*?</style>", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
        self._letters.update(unescape(_TAG.sub("", svg)))
        return Markup(_TAG.sub(partial(self._tag, path.stem), svg))

    def _tag(self, picture: str, tag: re.Match[str]) -> str:
        """Its ids are apart from those of other pictures, which may be hidden."""
        text = re.sub(r' (xmlns[\w:]*|version)="[^"]*"', "", tag[0]).replace("xlink:", "")
        text = re.sub(r'(id="|url\(#|href="#)([^")]+)', partial(self._id, picture), text)
        return re.sub(r'style="([^"]*)"', self._class, text)

    def _id(self, picture: str, found: re.Match[str]) -> str:
        return found[1] + self._ids.setdefault((picture, found[2]), f"i{len(self._ids)}")

    def _class(self, look: re.Match[str]) -> str:
        return f'class="{self._looks.setdefault(look[1], f"l{len(self._looks)}")}"'

    @property
    def style(self) -> Markup:
        looks = "".join(f".{name}{{{look}}}" for look, name in self._looks.items())
        css = _fonts("".join(sorted(self._letters))) + looks
        return Markup(css.replace(f"'{style.FONT}'", "Pictures"))
