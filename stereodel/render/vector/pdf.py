"""Pages as PDF: exact curves, text as text, balls shaded by gradients.

The same shapes and glyphs as in SVG, in points from the lower left corner, with three decimals. The used glyphs of
fonts are embedded, with their characters. The file has one page, in version 1.4 of the format (ISO 32000-1, 2008).
"""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby, pairwise

import numpy as np

from stereodel._arrays import FloatArray, Pixels
from stereodel.drawing.page import Ball, Label, Page
from stereodel.drawing.page.colors import Color
from stereodel.drawing.page.items import Ramp
from stereodel.drawing.page.style import PRINT_DPI
from stereodel.render.vector.outlines import Drawn, Filled, Outlines, Shape, Shown, ground, shapes
from stereodel.render.vector.paper import Paper, commands, exact, number, numbers, shades
from stereodel.render.vector.type import Face, Line, Subset, advance_of, lines_of, subsets


def pdf(page: Page, pictures: Sequence[Pixels] = ()) -> bytes:
    """A page as the bytes of a PDF file; `pictures` hold the whole page for each of `page.pictured`, which clips it."""
    return _PdfSheet(page).file(pictures)


class _Objects:
    """The numbered objects of a file."""

    def __init__(self) -> None:
        self.bodies: list[bytes] = []

    def add(self, body: str | bytes) -> str:
        """Add an object and return the reference to it."""
        self.bodies.append(body if isinstance(body, bytes) else body.encode("ascii"))
        return f"{len(self.bodies)} 0 R"

    def stream(self, data: bytes, entries: str = "") -> str:
        """Add a compressed stream."""
        packed = zlib.compress(data, 9)
        head = f"<< {entries} /Filter /FlateDecode /Length {len(packed)} >>\nstream\n".encode("ascii")
        return self.add(head + packed + b"\nendstream")

    def file(self, catalog: str, info: str) -> bytes:
        """The whole file, with the table of object offsets."""
        file = bytearray(b"%PDF-1.4\n%\xb5\xb6\xb7\xb8\n")
        places = []
        for count, body in enumerate(self.bodies, start=1):
            places.append(len(file))
            file += b"%d 0 obj\n%s\nendobj\n" % (count, body)
        name = hashlib.sha256(file).hexdigest()[:32]
        begin, size = len(file), len(places) + 1
        table = "".join(f"{place:010d} 00000 n \n" for place in places)
        file += f"xref\n0 {size}\n0000000000 65535 f \n{table}".encode("ascii")
        trailer = f"<< /Size {size} /Root {catalog} /Info {info} /ID [<{name}> <{name}>] >>"
        file += f"trailer\n{trailer}\nstartxref\n{begin}\n%%EOF\n".encode("ascii")
        return bytes(file)


class _PdfSheet:
    """A page being written."""

    def __init__(self, page: Page) -> None:
        self.page, self.paper, self.objects = page, Paper.of(page, downward=False), _Objects()
        # Names of resources in the content, by kind and resource.
        self.resources: dict[str, dict[str, str]] = {"Font": {}, "XObject": {}, "Pattern": {}, "ExtGState": {}}

    def file(self, pictures: Sequence[Pixels]) -> bytes:
        page, add = self.page, self.objects.add
        lettering = list(lines_of(page))
        fonts = subsets(line for _, lines in lettering for line in lines)
        named = {path: self.named("Font", _font(self.objects, font)) for path, font in fonts.items()}
        parts = [
            *map(self.shape, ground(page)),
            *(self.shape(shape) for shape in shapes(page, PRINT_DPI, pictures)),
            *(self.label(label, lines, named) for label, lines in lettering),
        ]
        content = self.objects.stream("".join(parts).encode("ascii"))
        used = {kind: {name: body for body, name in known.items()} for kind, known in self.resources.items() if known}
        resources = " ".join(f"/{kind} {_dictionary(entries)}" for kind, entries in used.items())
        box = f"[0 0 {number(page.width)} {number(page.height)}]"
        pages = f"{len(self.objects.bodies) + 2} 0 R"
        sheet = add(
            f"<< /Type /Page /Parent {pages} /MediaBox {box} /Resources << {resources} >> /Contents {content} "
            "/Group << /S /Transparency /CS /DeviceRGB >> >>"
        )
        add(f"<< /Type /Pages /Kids [{sheet}] /Count 1 >>")
        shown = " /ViewerPreferences << /DisplayDocTitle true >>" if page.title else ""
        catalog = add(f"<< /Type /Catalog /Pages {pages}{shown} >>")
        told = {"Title": page.title, "Subject": page.description}
        info = add(_dictionary({key: f"<{_utf16(text, mark=True)}>" for key, text in told.items() if text}))
        return self.objects.file(catalog, info)

    def named(self, kind: str, body: str) -> str:
        """The name of a resource in the content, the same for equal resources."""
        entries = self.resources[kind]
        return entries.setdefault(body, f"{kind[0]}{len(entries) + 1}")

    def opacity(self, color: Color) -> str:
        if color[3] == 1:
            return ""
        settings = f"<< /Type /ExtGState /CA {exact(color[3])} /ca {exact(color[3])} >>"
        return f"/{self.named('ExtGState', settings)} gs\n"

    def path(self, outline: Outlines) -> str:
        return commands(self.paper.placed(outline))

    def shape(self, shape: Shape) -> str:
        match shape:
            case Filled():
                paint = f"{_rgb(shape.color)} rg"
                if shape.light:
                    paint = f"/Pattern cs /{self.named('Pattern', self.gradient(shape.light, shape.color))} scn"
                fill = "f*" if shape.even_odd else "f"
                return f"q\n{self.opacity(shape.color)}{paint}\n{self.path(shape.outline)}{fill}\nQ\n"
            case Drawn():
                dash = f"[{numbers(shape.dash)}] 0 d\n" if shape.dash else ""
                return (
                    f"q\n{self.opacity(shape.color)}{_rgb(shape.color)} RG\n{exact(shape.width)} w\n"
                    f"{int(shape.cap == 'round')} J 1 j\n{dash}{self.path(shape.outline)}S\nQ\n"
                )
            case Shown():
                left, right, bottom, top = shape.extent
                (x, y), (end, high) = self.paper.points([(left, bottom), (right, top)]).tolist()
                place = numbers((end - x, 0, 0, high - y, x, y))
                image = self.named("XObject", _image(self.objects, shape.pixels))
                return f"q\n{self.path(shape.outline)}W n\n{place} cm\n/{image} Do\nQ\n"

    def gradient(self, light: Ball | Ramp, color: Color) -> str:
        """A colour shaded by a ball, or the colours of a ramp: a pattern that is linear between colours."""
        if isinstance(light, Ball):
            focus, center, radius = self.paper.shading(light)
            kind, places = 3, f"{numbers(focus)} 0 {numbers(center)} {number(radius)}"
        else:
            kind, places = 2, numbers(self.paper.points([(x, 0.0) for x in light.ends]).ravel())
        offsets, colors = zip(*((at, _rgb(shade)) for at, shade in shades(light, color)), strict=True)
        parts = " ".join(
            f"<< /FunctionType 2 /Domain [0 1] /N 1 /C0 [{one}] /C1 [{other}] >>" for one, other in pairwise(colors)
        )
        bounds = exact(*offsets[1:-1])
        function = (
            f"<< /FunctionType 3 /Domain [0 1] /Functions [{parts}] /Bounds [{bounds}] "
            f"/Encode [{' '.join(['0 1'] * (len(colors) - 1))}] >>"
        )
        return (
            f"<< /Type /Pattern /PatternType 2 /Shading << /ShadingType {kind} /ColorSpace /DeviceRGB "
            f"/Coords [{places}] /Extend [true true] "
            f"/Function {function} >> >>"
        )

    def label(self, label: Label, lines: Iterable[Line], named: dict[Face, str]) -> str:
        """A label: halo, lines of type and bars."""
        parts, lines = ["q\n"], list(lines)
        if label.halo:
            halo = "".join(commands(line.outline) for line in lines)
            parts.append(
                f"q\n{self.opacity(label.halo_color)}{_rgb(label.halo_color)} RG\n"
                f"{exact(2 * label.halo)} w 1 j\n{halo}S\nQ\n"
            )
        parts.append(f"{self.opacity(label.color)}{_rgb(label.color)} rg\n")
        for line in lines:
            shown = "".join(["BT\n", *_shows(line, named), "ET\n"])
            # Marks are not in the order of glyphs. Right-to-left letters are stored in reverse.
            if line.shaped and not line.leftward:
                shown = f"/Span << /ActualText <{_utf16(line.words, mark=True)}> >> BDC\n{shown}EMC\n"
            parts.append(shown)
            if line.bars:
                parts.append(f"{commands(line.placed(line.bar_outline))}f\n")
        return "".join([*parts, "Q\n"])


def _shows(line: Line, named: dict[Face, str]) -> Iterator[str]:
    """The operators of a line of type: runs of glyphs of one font, size and height, with adjustments between them."""
    matrix = line.matrix
    turned = exact(*matrix[:, :2].T.ravel())
    for (font, size, y), group in groupby(line.glyphs, key=lambda glyph: (glyph.font, glyph.size, glyph.y)):
        glyphs = list(group)
        begin: FloatArray = matrix @ [glyphs[0].x, y, 1.0]
        pen, shown = glyphs[0].x, ""
        for glyph in glyphs:
            # Adjustments in thousandths of the size, relative to the accumulated position; widths are rounded by less.
            step = round(1000 * (pen - glyph.x) / size, 2)
            if abs(step) >= 0.05:
                shown += f">{exact(step)}<"
                pen -= step * size / 1000
            shown += f"{glyph.index:04X}"
            pen += advance_of(font, glyph.index) * size
        yield f"/{named[font]} {exact(size)} Tf\n{turned} {numbers(begin)} Tm\n[<{shown}>] TJ\n"


def _font(objects: _Objects, font: Subset) -> str:
    """A font with glyphs by index, and their characters."""
    face = font.face
    head, across = face["head"], face["hhea"]
    scale = 1000 / head.unitsPerEm
    box = numbers(scale * side for side in (head.xMin, head.yMin, head.xMax, head.yMax))
    data = font.file()
    # PDF requires a width of stems, which is not used for embedded fonts.
    descriptor = objects.add(
        f"<< /Type /FontDescriptor /FontName /{font.name} /Flags {4 + 32 * (head.macStyle & 2)} /FontBBox [{box}] "
        f"/ItalicAngle {number(face['post'].italicAngle)} /Ascent {number(scale * across.ascent)} "
        f"/Descent {number(scale * across.descent)} /CapHeight {number(scale * across.ascent)} /StemV 80 "
        f"/FontFile2 {objects.stream(data, f'/Length1 {len(data)}')} >>"
    )
    widths = " ".join(f"{index} [{exact(1000 * advance_of(font.font, index))}]" for index in sorted(font.glyphs))
    glyphs = objects.add(
        f"<< /Type /Font /Subtype /CIDFontType2 /BaseFont /{font.name} /CIDToGIDMap /Identity /DW 0 /W [{widths}] "
        f"/CIDSystemInfo << /Registry (Adobe) /Ordering (Identity) /Supplement 0 >> /FontDescriptor {descriptor} >>"
    )
    return objects.add(
        f"<< /Type /Font /Subtype /Type0 /BaseFont /{font.name} /Encoding /Identity-H /DescendantFonts [{glyphs}] "
        f"/ToUnicode {objects.stream(_characters(font).encode('ascii'))} >>"
    )


def _characters(font: Subset) -> str:
    """The map from glyphs to characters, in blocks of at most a hundred as the format requires."""
    entries = [f"<{index:04X}> <{_utf16(text)}>" for index, text in sorted(font.glyphs.items())]
    blocks = [entries[first : first + 100] for first in range(0, len(entries), 100)]
    maps = "".join(f"{len(block)} beginbfchar\n{chr(10).join(block)}\nendbfchar\n" for block in blocks)
    return (
        "/CIDInit /ProcSet findresource begin\n12 dict begin\nbegincmap\n"
        "/CIDSystemInfo << /Registry (Adobe) /Ordering (UCS) /Supplement 0 >> def\n"
        "/CMapName /Adobe-Identity-UCS def\n/CMapType 2 def\n"
        f"1 begincodespacerange\n<0000> <FFFF>\nendcodespacerange\n{maps}"
        "endcmap\nCMapName currentdict /CMap defineresource pop\nend\nend\n"
    )


def _image(objects: _Objects, pixels: Pixels) -> str:
    """An image, with a mask if it is transparent."""
    height, width = pixels.shape[:2]
    size = f"/Type /XObject /Subtype /Image /Width {width} /Height {height} /BitsPerComponent 8"
    mask = ""
    if pixels.shape[2] == 4 and (pixels[..., 3] < 255).any():
        opacity = np.ascontiguousarray(pixels[..., 3]).tobytes()
        mask = f" /SMask {objects.stream(opacity, f'{size} /ColorSpace /DeviceGray')}"
    data = np.ascontiguousarray(pixels[..., :3]).tobytes()
    return objects.stream(data, f"{size} /ColorSpace /DeviceRGB{mask}")


def _dictionary(entries: dict[str, str]) -> str:
    return "<< " + " ".join(f"/{key} {value}" for key, value in entries.items()) + " >>"


def _utf16(text: str, *, mark: bool = False) -> str:
    """Text as hexadecimal digits, with a byte order mark where the encoding is ambiguous."""
    return ("\ufeff" * mark + text).encode("utf-16-be").hex().upper()


def _rgb(color: Iterable[float]) -> str:
    return exact(*[*color][:3])
