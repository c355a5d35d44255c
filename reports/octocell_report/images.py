# SPDX-License-Identifier: MIT
"""Figures as files, and files as pictures of the page."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from matplotlib.figure import Figure
from PIL import Image

from octocell_report import style

ENDINGS = ("png", "svg")
_COLOURS = 256  # of a plot, and half the size; with 128 rare reds become brown
_CSS_DPI = 96


class Picture(NamedTuple):
    uri: str
    width: int  # in CSS pixels
    height: int


def write(figures: Iterable[tuple[str, Figure]], folder: Path) -> None:
    """Each as NAME.png and NAME.svg."""
    for name, figure in figures:
        _save(figure, folder / f"{name}.png")
        figure.set_layout_engine("none")  # the layout stands: to find it takes longer than to draw
        # No date and no random ids in it: the same result gives the same file.
        figure.savefig(folder / f"{name}.svg", metadata={"Date": None})


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


def picture(path: Path) -> Picture | None:
    """As lossless WebP, half as large as PNG; None if there is no such file."""
    if not path.exists():
        return None
    buffer = io.BytesIO()
    with Image.open(path) as image:
        image.convert("RGB").save(buffer, "WEBP", lossless=True, quality=50)
        width, height = (round(side * _CSS_DPI / style.DPI) for side in image.size)
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    return Picture(f"data:image/webp;base64,{data}", width, height)
