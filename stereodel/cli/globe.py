"""`stereodel globe`: pictures and films of globes under conformal maps."""

from __future__ import annotations

from typing import Any

from stereodel.cli import globe_options as globe
from stereodel.cli import options

EXAMPLE = "stereodel globe --focus=2.35,48.86 --magnify 20 -o paris.png"

PICTURES = ("png", "svg", "pdf")
FILMS = ("gif", "webp", "apng", "mp4")
USUAL_WIDTH = "17cm"
SECONDS, FPS = 10.0, 25.0


def command(
    out: options.Out,
    points: globe.Points = None,
    show: globe.Shows = None,
    focus: globe.Focus = None,
    magnify: globe.Magnify = 1.0,
    view: globe.View = None,
    projection: globe.Flattened = globe.Projection.globe,
    angular_radius: globe.AngularRadius = 90.0,
    labels: globe.Labels = None,
    rank: globe.Rank = None,
    color: globe.PointColor = None,
    point_size: globe.PointSize = None,
    layer: globe.Layers = None,
    texture: globe.Texture = None,
    texture_box: globe.TextureBox = None,
    land: globe.Land = None,
    coastlines: globe.Coastlines = True,
    borders: globe.Borders = False,
    rivers: globe.Rivers = False,
    lakes: globe.Lakes = False,
    graticule: globe.Graticule = None,
    spin: globe.Spin = False,
    fly: globe.Fly = None,
    seconds: globe.Seconds = SECONDS,
    fps: globe.Fps = FPS,
    title: globe.Title = "",
    legend: globe.Legend = False,
    style: globe.Styles = None,
    width: globe.Width = USUAL_WIDTH,
    size: globe.Size = None,
    dpi: globe.Dpi = None,
    transparent: globe.Transparent = False,
    lon: options.Lon = None,
    lat: options.Lat = None,
    layer_name: options.LayerName = None,
    crs: options.Crs = None,
    skip_missing: options.SkipMissing = False,
    latitude: options.LatitudeKind = options.Latitude.authalic,
    format: globe.Format = None,
    overwrite: options.Overwrite = False,
    font: globe.Font = None,
) -> None:
    """Draw a globe under a conformal fisheye, with maps, points and their cells, and layers from files.

    A film (.gif, .webp, .apng or .mp4) makes one turn with --spin and flies to places with --fly; otherwise the focus
    grows and shrinks again.
    """
    from stereodel.cli.destinations import Destination
    from stereodel.cli.globe_aim import Aim, place
    from stereodel.cli.globe_films import FILM_SPACING, motion_of, save_film
    from stereodel.cli.globe_layers import (
        Features,
        LayerChoice,
        PointLooks,
        add_files,
        add_points,
        new_globe,
        texture_of,
    )
    from stereodel.cli.progress import stage
    from stereodel.cli.sources import read

    layers = [LayerChoice.of(text) for text in layer or ()]
    read_from = (points, texture, *(str(each.path) for each in layers), *(style or ()))
    destination = Destination.of(out, format, PICTURES + FILMS, *read_from, overwrite=overwrite)
    filming = destination.kind in FILMS
    looks = PointLooks(frozenset(show or ("points", "cells")), labels, rank, color, point_size)
    if points is None:
        looked = {"--labels": labels, "--color": color, "--point-size": point_size, "--show": show}
        options.refuse(looked, "POINTS; give a table, or --layer FILE,color=…")
        found = {"--lon": lon, "--lat": lat, "--layer-name": layer_name, "--crs": crs, "--skip-missing": skip_missing}
        options.refuse(found, "POINTS; give a table")
    if filming:
        printed = {"--legend": legend, "--style": style, "--dpi": dpi, "--transparent": transparent}
        options.refuse(printed | {"--width": width != USUAL_WIDTH}, "pictures, not for films")
    else:
        moving = {"--spin": spin, "--fly": fly, "--seconds": seconds != SECONDS, "--fps": fps != FPS}
        options.refuse(moving, f"films, but {out} is none; the endings are .{', .'.join(FILMS)}")
    aim = Aim(place(focus, "--focus"), magnify, place(view, "--view"), projection, angular_radius)
    table = None
    if points is not None:
        table = read(points, lon=lon, lat=lat, layer=layer_name, crs=crs, skip_missing=skip_missing)
    with stage("reading maps"):
        spacing = FILM_SPACING if graticule is None and filming else graticule
        features = Features(land, coastlines, borders, rivers, lakes, spacing, "50m" if filming else aim.resolution)
        drawing = new_globe(features, latitude, texture_of(texture, texture_box, latitude), title, font)
        add_files(drawing, layers)
        if table is not None:
            aim = aim.with_middle_of(table.points(latitude.value))
            add_points(drawing, table, looks)
    if filming:
        motion = motion_of(
            aim, spin=spin, stops=[options.pair(text, "--fly", "LON,LAT") for text in fly or ()], seconds=seconds
        )
        destination.write(lambda path: save_film(drawing, motion, path, size=size or 720, fps=fps, kept=out != "-"))
        return
    pixels = size or (1600 if dpi is None else None)
    paper: dict[str, Any] = {"width": width, "size": pixels, "dpi": dpi, "transparent": transparent}
    with stage("drawing"):
        destination.write(
            lambda path: drawing.save(path, aim.lens, aim.views, style=style or (), legend=legend, **paper)
        )
