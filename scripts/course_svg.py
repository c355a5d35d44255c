# SPDX-License-Identifier: MIT
"""A small canvas that writes SVG, for the pictures of the course."""

from __future__ import annotations

from html import escape

INK, GREY, PALE = "#1f2937", "#6b7280", "#d1d5db"
HOME, PHANTOM, LOST, FINE = "#0072b2", "#b9dcf0", "#d55e00", "#009e73"
OTHER, OTHER_PALE = "#8a5a00", "#f6dfa6"  # the second of two balls
FONT = "'Noto Sans','Noto Sans CJK SC','Microsoft YaHei','PingFang SC',sans-serif"


class Canvas:
    """Shapes in the order in which they are drawn. y grows downwards, as in SVG."""

    def __init__(self, width: float, height: float, title: str) -> None:
        self.size, self.title, self.parts = (width, height), title, list[str]()

    def add(self, text: str) -> None:
        self.parts.append(text)

    def box(self, x: float, y: float, w: float, h: float, fill: str = "white",
            edge: str = PALE, width: float = 1, dash: str = "") -> None:  # fmt: skip
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(
            f'<rect x="{x:.1f}" y="{y:.1f}" width="{w:.1f}" height="{h:.1f}" fill="{fill}" '
            f'stroke="{edge}" stroke-width="{width}"{dashes}/>'
        )

    def disc(self, x: float, y: float, r: float, fill: str = "none", edge: str = INK) -> None:
        self.add(
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" fill="{fill}" stroke="{edge}" '
            f'stroke-width="2"/>'
        )

    def line(self, x1: float, y1: float, x2: float, y2: float, colour: str = INK,
             width: float = 1.5, arrow: bool = False, dash: str = "") -> None:  # fmt: skip
        end = ' marker-end="url(#head)"' if arrow else ""
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(
            f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
            f'stroke-width="{width}"{dashes}{end}/>'
        )

    def text(self, x: float, y: float, words: object, size: int = 15, colour: str = INK,
             anchor: str = "middle", bold: bool = False) -> None:  # fmt: skip
        weight = ' font-weight="bold"' if bold else ""
        self.add(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" '
            f'text-anchor="{anchor}"{weight}>{escape(str(words))}</text>'
        )

    def cell_row(self, x: float, y: float, values: list[str], fills: list[str],
                 width: float = 58, height: float = 34) -> None:  # fmt: skip
        """An array: values side by side."""
        for k, (value, fill) in enumerate(zip(values, fills, strict=True)):
            self.box(x + k * width, y, width, height, fill, GREY)
            dark = fill in (HOME, LOST, FINE, GREY, OTHER)
            self.text(x + (k + 0.5) * width, y + height / 2 + 5, value,
                      colour="white" if dark else INK)  # fmt: skip

    def svg(self) -> str:
        width, height = self.size
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" '
            f'width="{width:g}" height="{height:g}" role="img" font-family="{FONT}">\n'
            f"<title>{escape(self.title)}</title>\n"
            '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" '
            'markerHeight="7" orient="auto">'
            f'<path d="M0 0 8 4 0 8z" fill="{INK}"/></marker></defs>\n'
            f'<rect width="{width:g}" height="{height:g}" fill="white"/>\n'
        )
        return head + "\n".join(self.parts) + "\n</svg>\n"


class Plane:
    """Maps the x-y plane of a scene onto a part of a canvas; y of the scene grows upwards."""

    def __init__(self, canvas: Canvas, at: tuple[float, float], low: tuple[float, float],
                 high: tuple[float, float], scale: float) -> None:  # fmt: skip
        self.canvas, self.at, self.low, self.high, self.scale = canvas, at, low, high, scale

    def x(self, x: float) -> float:
        return self.at[0] + (x - self.low[0]) * self.scale

    def y(self, y: float) -> float:
        return self.at[1] + (self.high[1] - y) * self.scale

    def cell(self, i: int, j: int, side: float, fill: str, edge: str = PALE) -> None:
        """A cell, cut off where the plane ends."""
        left, top = self.x(i * side), max(self.y((j + 1) * side), self.at[1])
        right = min(self.x((i + 1) * side), self.x(self.high[0]))
        self.canvas.box(left, top, right - left, self.y(j * side) - top, fill, edge)

    def grid(self, side: float, columns: range, rows: range) -> None:
        for i in columns:
            for j in rows:
                self.cell(i, j, side, "white")

    def ball(self, x: float, y: float, r: float, name: object, colour: str = INK) -> None:
        self.canvas.disc(self.x(x), self.y(y), r * self.scale, edge=colour)
        self.canvas.disc(self.x(x), self.y(y), 3, fill=colour, edge=colour)
        self.canvas.text(self.x(x) - 8, self.y(y) - 6, name, colour=colour, anchor="end",
                         bold=True)  # fmt: skip

    def join(self, a: tuple[float, float], b: tuple[float, float], colour: str) -> None:
        self.canvas.line(self.x(a[0]), self.y(a[1]), self.x(b[0]), self.y(b[1]), colour, 4)
