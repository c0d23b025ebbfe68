"""`stereodel panorama`: 360° images through a conformal lens."""

from __future__ import annotations

from typing import Annotated, Literal

import typer

from stereodel.cli import options

EXAMPLE = "stereodel panorama room.jpg --focus=90,-10 --magnify 3 -o desk.jpg"

PICTURES = ("jpg", "jpeg", "png", "webp")
Form = Literal["equirectangular", "cubemap", "planet"]


@options.grouped
def command(
    *,
    picture: Annotated[str, typer.Argument(metavar="PICTURE", help="Twice as wide as high: .jpg, .png, .webp, .tif …")],
    output: options.Output,
    focus: options.Focus = None,
    magnify: options.Magnify = 1.0,
    to: Annotated[Form, typer.Option(help="Another panorama, six faces of a cube, or a planet.")] = "equirectangular",
    view: Annotated[str | None, typer.Option(metavar="LON,LAT", help="Centre; else 0,0, of planets 0,-90.")] = None,
    size: Annotated[int | None, typer.Option(min=1, metavar="PIXELS", help="Width, or that of a face.")] = None,
    angular_radius: Annotated[float, typer.Option(metavar="DEGREES", help="Angular radius of a planet.")] = 140.0,
    faces: Annotated[bool, typer.Option("--faces", help="A file for each face of a cubemap: NAME_right.jpg …")] = False,
) -> None:
    """Write a 360° picture as seen through a conformal fisheye: places near the focus grow, circles stay round.

    Longitude and latitude are those of the picture: 0,0 is its centre, 0,90 straight up.
    """
    from dataclasses import replace
    from pathlib import Path

    from stereodel import fisheye
    from stereodel.cli.application import reporting
    from stereodel.drawing import View
    from stereodel.globe.panoramas import face_paths, save_panorama

    if faces and to != "cubemap":
        raise ValueError(f"--faces requires --to cubemap, but --to is {to}")
    if faces and output.out == "-":
        raise ValueError("--faces are six files, and stdout is one; name a file with --out")
    destination = replace(output, overwrite=output.overwrite and not faces).of(PICTURES, picture)
    for name in face_paths(Path(output.out)) if faces else ():
        replace(output, out=str(name)).of(PICTURES, picture)
    seen = None if view is None else options.place(view, "--view")
    at = None if focus is None else options.place(focus, "--focus")
    if at is None and magnify != 1:
        at = seen or (0.0, -90.0 if to == "planet" else 0.0)
    lens = fisheye(at, magnification=magnify) if at else None
    with reporting("drawing"), destination.file() as path:
        middle = View(*seen) if seen else None
        save_panorama(picture, path, lens, to, view=middle, size=size, angular_radius=angular_radius, faces=faces)
