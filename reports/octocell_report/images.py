# SPDX-License-Identifier: MIT
"""Figures as files, and files as text of the page."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image

from octocell_report import style

ENDINGS = ("png", "svg")


def write(figures: Iterable[tuple[str, Figure]], folder: Path) -> None:
    """Each as NAME.png and NAME.svg."""
    for name, figure in figures:
        _save(figure, folder / f"{name}.png")
        # No date and no random ids in it: the same result gives the same file.
        figure.savefig(folder / f"{name}.svg", metadata={"Date": None})


def files_of(names: Iterable[str]) -> set[str]:
    """What write() may write of figures with these names."""
    return {f"{name}.{ending}" for name in names for ending in ENDINGS}


def drawn(names: Iterable[str], folder: Path) -> list[str]:
    """Those that had something to show, so that they lie in the folder."""
    return [name for name in names if (folder / f"{name}.png").exists()]


def _save(figure: Figure, path: Path) -> None:
    """With 256 colours: a third of the size, and no difference to the eye in a plot."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=style.DPI)
    with Image.open(buffer) as image:
        image.convert("RGB").quantize(256).save(path, optimize=True)


def data_uri(path: Path) -> str:
    return f"data:image/png;base64,{base64.b64encode(path.read_bytes()).decode('ascii')}"
