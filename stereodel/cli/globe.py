"""`stereodel globe`: pictures of globes that bend."""

from __future__ import annotations

from stereodel.cli import globe_options as globe
from stereodel.cli import options

EXAMPLE = "stereodel globe --focus=2.35,48.86 --magnify 20 -o paris.png"

PICTURES = ("png", "svg", "pdf")


def command(
    out: options.Out,
    points: globe.Points = None,
    show: globe.Shows = None,
    focus: globe.Focus = None,
    magnify: globe.Magnify = 1.0,
    view: globe.View = None,
    projection: globe.Flattened = globe.Projection.globe,
    extent: globe.Extent = 90.0,
    layer: globe.Layers = None,
    texture: globe.Texture = None,
    texture_box: globe.TextureBox = None,
    land: globe.Land = None,
    coastlines: globe.Coastlines = True,
    borders: globe.Borders = False,
    rivers: globe.Rivers = False,
    lakes: globe.Lakes = False,
    graticule: globe.Graticule = 15.0,
    size: globe.Size = 1600,
    lon: options.Lon = None,
    lat: options.Lat = None,
    latitude: options.LatitudeKind = options.Latitude.spherical,
    format: globe.Format = None,
) -> None:
    """Draw a globe that bends: maps, points with their cells and files, under a conformal fisheye."""
    from stereodel.cli.destinations import Destination
    from stereodel.cli.globe_aim import Aim, place
    from stereodel.cli.globe_layers import Features, add_files, add_points, new_globe, texture_of
    from stereodel.cli.progress import stage
    from stereodel.cli.sources import read

    destination = Destination.of(out, format, PICTURES)
    aim = Aim(place(focus, "--focus"), magnify, place(view, "--view"), projection, extent)
    table = read(points, lon=lon, lat=lat) if points is not None else None
    with stage("reading maps"):
        features = Features(land, coastlines, borders, rivers, lakes, graticule)
        drawing = new_globe(features, latitude, texture_of(texture, texture_box))
        add_files(drawing, layer or ())
        if table is not None:
            aim = aim.with_middle_of(table.points(latitude))
            add_points(drawing, table, frozenset(show or ("points", "cells")))
    with stage("drawing"):
        destination.write(lambda path: drawing.save(path, aim.lens, aim.views, size=size))
