"""The matplotlib projection: what a user of pyplot does, and files that come out of it."""

import json
import subprocess
import sys

import geopandas
import matplotlib.pyplot as plt
import numpy as np
import pytest
import shapely
from matplotlib.backend_bases import MouseButton
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.path import Path

import stereodel.mpl
from stereodel import MoebiusMap, data, fisheye, xyz_to_lonlat
from stereodel.curves.view import StereographicView, View
from stereodel.mpl import FisheyeAxes
from stereodel.sphere.arcs import graticule
from tests.globe.sights import disc
from tests.refused import refused

PARIS = (2.35, 48.86)
GRID = np.linspace(-180, 180, 37), np.linspace(-90, 90, 19)


def axes_of(**options):
    return Figure(figsize=(4, 4), dpi=100).add_subplot(projection=FisheyeAxes, **options)


def area(path):
    """Of the closed parts of a path, holes off."""
    begins = np.flatnonzero(path.codes == Path.MOVETO) if len(path.vertices) else []
    loops = [loop.T for loop in np.split(path.vertices, begins[1:])] if len(begins) else []
    return sum(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) for x, y in loops) / 2


def pixels(axes):
    canvas = FigureCanvasAgg(axes.figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].astype(int)


def test_the_class_is_a_projection():
    axes = plt.subplot(projection=FisheyeAxes, focus=PARIS, magnification=20)
    assert isinstance(axes, FisheyeAxes)
    assert np.allclose(axes.transGlobe.transform(PARIS), 0, atol=1e-15)
    assert plt.subplot(projection=FisheyeAxes, focus=PARIS, magnification=20) is axes
    _, both = plt.subplots(1, 2, subplot_kw={"projection": FisheyeAxes, "focus": PARIS})
    assert all(isinstance(one, FisheyeAxes) for one in both)
    plt.close("all")


def test_the_name_is_known_once_it_is_registered():
    """And not before: an import changes nothing."""
    code = "from matplotlib.projections import get_projection_names as names; import stereodel.mpl\n"
    code += "print('stereodel.fisheye' in names()); stereodel.mpl.register(); stereodel.mpl.register()\n"
    code += "print(names().count('stereodel.fisheye'))"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["False", "1"]
    stereodel.mpl.register()
    axes = plt.subplot(projection="stereodel.fisheye", focus=PARIS, magnification=20)
    assert isinstance(axes, FisheyeAxes)
    plt.close()


def test_the_view_is_above_the_focus_or_where_it_is_wanted():
    lens = fisheye(PARIS, magnification=3.0) @ MoebiusMap.rotation((0, 90), 20)
    place = (PARIS[0] - 20, PARIS[1])
    assert np.allclose(axes_of(lens=lens).transGlobe.transform(place), 0, atol=1e-12)
    for view in ((30, 10), [30, 10], np.array([30, 10]), View(30, 10), StereographicView(30, 10, angular_radius=150)):
        assert np.allclose(axes_of(view=view).transGlobe.transform((30, 10)), 0, atol=1e-12)


test_wrong_options = refused(
    ({"magnification": 0}, "magnification is 0"),
    ({"magnification": np.inf}, "magnification"),
    ({"focus": (0, 95)}, "latitude 95"),
    ({"view": (0, 95)}, "latitude 95"),
    ({"edges": "curved"}, "edges is 'curved'"),
    ({"lens": MoebiusMap.identity(), "focus": PARIS}, "lens was given together with"),
    call=lambda options: axes_of(**options),
)


def test_data_is_in_degrees():
    axes = axes_of(focus=PARIS, magnification=4)
    (line,) = axes.plot([2.35, -74], [48.86, 40.7], "o-")
    dots = axes.scatter([2.35, 174], [48.86, -41])
    pixel = axes.transData.transform([PARIS, (174, -41)])
    middle = axes.transAxes.transform((0.5, 0.5))
    assert np.allclose(pixel[0], middle)
    assert np.isnan(pixel[1]).all()
    assert line.get_transform() == dots.get_offset_transform() == axes.transData
    text = axes.text(174, -41, "Wellington")
    axes.annotate("Paris", PARIS, (10, 10), textcoords="offset points", arrowprops={"arrowstyle": "->"})
    pixels(axes)
    assert text.get_position() == (174, -41)


def test_contours_cover_the_disc_and_lines_do_not_follow_it():
    lon, lat = np.meshgrid(*GRID)
    height = np.cos(np.radians(3 * lon)) * np.cos(np.radians(lat)) ** 2 + np.sin(np.radians(2 * lat))
    axes = axes_of(focus=PARIS, magnification=3, view=(40, -20))
    filled = axes.contourf(lon, lat, height, levels=7)
    areas = [area(axes.transGlobe.transform_path(path)) for path in filled.get_paths()]
    assert sum(areas) == pytest.approx(np.pi, rel=1e-3)
    assert min(areas) >= 0
    lines = axes.contour(lon, lat, height, levels=7)
    for path in lines.get_paths():
        page = axes.transGlobe.transform_path(path).vertices
        # The limb would take hundreds of points; a line comes there to end.
        assert np.count_nonzero(np.hypot(*page.T) > 1 - 1e-9) <= 24
    # Of scattered points, whose hull has edges that run close by the poles, over more than half of the map.
    lon, lat = xyz_to_lonlat(np.random.default_rng(1).normal(size=(3000, 3))).T
    filled = axes.tricontourf(lon, lat, np.sin(np.radians(2 * lon)) * np.cos(np.radians(lat)), levels=9)
    covered = sum(area(axes.transGlobe.transform_path(path)) for path in filled.get_paths())
    assert covered == pytest.approx(np.pi, rel=1e-3)
    for path in axes.tricontour(lon, lat, np.sin(np.radians(lat)), levels=[0.0]).get_paths():
        assert path.codes is None or path.CLOSEPOLY not in path.codes


@pytest.mark.parametrize("sight", [{}, {"magnification": 30}, {"view": StereographicView(10, 80, angular_radius=150)}])
def test_cells_of_a_grid_tile_the_disc(sight):
    axes = axes_of(focus=PARIS, **sight)
    lon, lat = np.meshgrid(*GRID)
    mesh = axes.pcolormesh(lon, lat, np.arange(18 * 36).reshape(18, 36), cmap="viridis")
    axes.figure.colorbar(mesh)
    areas = np.array([abs(area(path)) for path in mesh.get_paths()])
    assert len(areas) == 18 * 36
    assert areas.sum() == pytest.approx(np.pi, rel=1e-3)
    around = axes.pcolormesh(lon[:, :-1] + 5, lat[:, :-1], lat[:, :-1])  # values on the poles
    assert sum(abs(area(path)) for path in around.get_paths()) == pytest.approx(np.pi, rel=1e-3)
    seen = axes.transGlobe.inverted().transform((0.3, 0.2))
    number = int((seen[1] + 90) // 10 * 36 + (seen[0] + 180) // 10)
    assert mesh.get_paths()[number].contains_point((0.3, 0.2))
    assert mesh.get_array()[number] == number


def test_hexagons_tile_the_disc_where_points_are():
    axes = axes_of(focus=PARIS, magnification=2)
    lon, lat = (grid.ravel() for grid in np.meshgrid(np.arange(-180, 180, 3), np.arange(-60, 89, 3)))
    cells = axes.hexbin(lon, lat, gridsize=20, edgecolors="w", linewidths=2)
    assert cells.get_array().sum() == len(lon)
    covered = [axes.transGlobe.transform_path(path) for path in cells.get_paths()]
    assert sum(abs(area(path)) for path in covered) == pytest.approx(np.pi, rel=0.01)
    assert cells.get_edgecolor().tolist() == [[1, 1, 1, 1]]


def test_arrows_point_east_and_north():
    """Along the images of parallel and meridian, with their lengths; at the north pole, too."""
    axes = axes_of(focus=PARIS, magnification=3, view=StereographicView(20, 60, angular_radius=120))
    lon, lat = np.array([0.0, 50, 20, 10]), np.array([40.0, 60, 80, 30])
    steps = []
    for east, north, way in ((2.0, 0.0, (1e-3, 0)), (0.0, 3.0, (0, 1e-3))):
        arrows = axes.quiver(lon, lat, np.full(4, east), np.full(4, north))
        page = axes.transGlobe.transform(np.column_stack([lon, lat]) + way)
        page -= axes.transGlobe.transform(np.column_stack([lon, lat]))
        steps.append(np.column_stack([arrows.U, arrows.V]))
        wanted = page / np.hypot(*page.T)[:, None] * (east + north)
        assert np.allclose(steps[-1], wanted, atol=1e-3)
    assert np.allclose(np.sum(steps[0] * steps[1], axis=1), 0, atol=1e-3)  # conformal
    axes.quiver([0.0], [90.0], [1.0], [1.0])
    axes.barbs(lon, lat, lat, lon)
    pixels(axes)
    with pytest.raises(TypeError, match="lon, lat, east, north"):
        axes.quiver([1.0], [2.0])


def test_pictures_of_the_page_alone():
    axes = axes_of()
    axes.imshow(np.zeros((4, 4)), extent=(-1, 1, -1, 1), transform=axes.transPage)
    assert axes.get_xlim() == (-1, 1)
    with pytest.raises(ValueError, match="imshow cannot warp an image"):
        axes.imshow(np.zeros((4, 4)))


def test_geometries_of_every_kind():
    axes = axes_of(focus=(170, 0), magnification=2)
    ring = shapely.box(150, 20, 155, 25).difference(shapely.box(151, 21, 154, 24))
    lines = shapely.MultiLineString([[(160, 1), (165, 2)], [(1, 1), (2, 2)]])
    shapes = [shapely.box(160, -10, 200, 10), shapely.MultiPolygon([shapely.box(0, 0, 5, 5), ring])]
    shapes += [shapely.LineString([(150, -20), (190, -30)]), shapely.GeometryCollection([shapely.Point(170, 5), lines])]
    shapes += [shapely.Polygon()]
    drawn = axes.add_geometries(shapes, facecolor="tab:blue")
    assert len(drawn.get_paths()) == 6
    assert len(axes.collections) == 2  # and the point
    frame = geopandas.GeoSeries([shapely.box(160, -10, 170, 10)], crs=4326).to_crs(3857)
    (path,) = axes.add_geometries(frame).get_paths()
    assert np.allclose(path.get_extents().extents, (160, -10, 170, 10), atol=1e-9)
    with pytest.raises(ValueError, match="latitude 100"):
        axes.add_geometries(shapely.Point(0, 100))


def test_geometries_from_files_and_in_the_order_of_their_features(tmp_path):
    axes = axes_of()
    shapes = [shapely.LineString([(0, 0), (1, 1)]), shapely.box(0, 0, 2, 2), shapely.LineString([(0, 0), (3, 3)])]
    features = [{"type": "Feature", "properties": {}, "geometry": shapely.geometry.mapping(shape)} for shape in shapes]
    content = {"type": "FeatureCollection", "features": features}
    (tmp_path / "shapes.geojson").write_text(json.dumps(content))
    for source in (shapes, content, tmp_path / "shapes.geojson"):
        drawn = axes.add_geometries(source).get_paths()
        assert [path.get_extents().x1 for path in drawn] == [1, 2, 3]
        assert [Path.CLOSEPOLY in path.codes for path in drawn] == [False, True, False]


@pytest.mark.parametrize("backwards", [False, True])
def test_a_hole_in_what_covers_the_view_stays_open(backwards):
    """matplotlib fills by the nonzero rule: the edge of the view must run against the hole."""
    world = shapely.box(-180, -90, 180, 90).difference(shapely.box(-20, -20, 20, 20))
    world = shapely.orient_polygons(world, exterior_cw=backwards)
    axes = axes_of(view=(0, 0))
    axes.set_position((0, 0, 1, 1))
    axes.add_geometries(world, facecolor="red", edgecolor="none")
    picture = pixels(axes)
    assert picture[200, 200].tolist() == [255, 255, 255]
    assert picture[200, 60].tolist() == picture[60, 200].tolist() == [255, 0, 0]


def test_geopandas_plots_into_it():
    axes = axes_of(focus=(20, 10), magnification=2)
    frame = geopandas.GeoDataFrame(
        {"v": [1, 2]}, geometry=[shapely.box(0, 0, 40, 20), shapely.box(40, 0, 190, 20)], crs=4326
    )
    frame.plot(ax=axes, column="v")
    assert axes.get_aspect() == 1
    assert axes.get_xlim() == (-1, 1)
    assert len(np.unique(pixels(axes).reshape(-1, 3), axis=0)) > 5


def test_graticule_comes_and_goes():
    axes = axes_of(view=(0, 30))
    count = len(axes.patches)
    axes.grid(True)
    axes.grid(True, spacing=30, color="red")
    assert len(axes.patches) == count + 1
    assert axes.patches[-1].get_edgecolor() == (1, 0, 0, 1)
    axes.grid()
    assert len(axes.patches) == count
    with plt.rc_context({"axes.grid": True}):
        assert len(axes_of().patches) == count + 1
    with pytest.raises(ValueError, match="spacing is 7, but 180 must be a whole multiple"):
        axes.graticule(7)


def test_the_graticule_is_that_of_the_library():
    """As many lines, of all spacings that divide 180; parallels are followed as the circles that they are."""
    axes = axes_of(focus=PARIS, magnification=10)
    for spacing in (60, 36, 7.5):
        path = axes.graticule(spacing).get_path()
        assert np.count_nonzero(path.codes == Path.MOVETO) == len(graticule(spacing))
    page = axes.transPage.inverted().transform(
        axes.transStraight.transform_path(axes.graticule(30).get_path()).vertices
    )
    lines = axes.transGlobe.inverted().transform(page)
    off = np.abs(lines - 30 * np.round(lines / 30)).min(axis=1)
    assert off[np.abs(lines[:, 1]) < 89].max() < 1e-3
    vertical = axes_of(view=(0, 90))
    drawn = vertical.transStraight.transform_path(vertical.graticule(60).get_path()).vertices
    around = np.hypot(*vertical.transPage.inverted().transform(drawn).T)
    assert np.ptp(around[np.abs(around - 0.5) < 1e-3]) < 1e-12


def test_land_and_borders_of_the_package():
    """As much land as there is: of a hemisphere seen flat, the share of places in it."""
    axes = axes_of(focus=PARIS, view=StereographicView(2, 48, angular_radius=90))
    land, borders = axes.land("110m", color="green", lw=0), axes.borders("110m")
    assert land.get_facecolor() == (0, 128 / 255, 0, 1)
    assert land.get_edgecolor()[3] == 0
    assert len(axes.transGlobe.transform_path(borders.get_path()).vertices) > 1000
    drawn = axes.transStraight.transform_path(land.get_path())
    share = area(axes.transPage.inverted().transform_path(drawn)) / np.pi
    shapes = shapely.geometry.shape(data.land("110m").__geo_interface__)
    page = disc(60)
    spots = axes.transGlobe.inverted().transform(page[np.hypot(*np.moveaxis(page, -1, 0)) < 1])
    assert share == pytest.approx(shapely.contains_xy(shapes, *spots.T).mean(), abs=0.02)
    axes.add_geometries(data.countries("110m"), facecolor="none")


def test_pointer_reads_longitude_and_latitude():
    axes = axes_of(focus=PARIS, magnification=5)
    at = axes.transData.inverted().transform(axes.transAxes.transform((0.5, 0.5)))
    assert axes.format_coord(*at) == "48.8600° N, 2.3500° E"
    assert axes.format_coord(-70.5, -12.0) == "12.0000° S, 70.5000° W"
    corner = axes.transData.inverted().transform(axes.transAxes.transform((0.01, 0.01)))
    assert axes.format_coord(*corner) == ""


def test_zoom_box_and_pan_work_on_the_page():
    axes = axes_of(focus=PARIS)
    axes.figure.canvas.draw()
    (x0, y0), (x1, y1) = axes.transPage.transform([(-0.5, -0.25), (0.5, 0.75)])
    axes._set_view_from_bbox((x0, y0, x1, y1))  # as the toolbar does
    assert np.allclose([*axes.get_xlim(), *axes.get_ylim()], [-0.5, 0.5, -0.25, 0.75])
    axes.figure.canvas.draw()
    start = axes.transPage.transform((0.0, 0.0))
    axes.start_pan(*start, MouseButton.LEFT)
    axes.drag_pan(MouseButton.LEFT, None, *axes.transPage.transform((0.1, 0.0)))
    axes.end_pan()
    assert np.allclose(axes.get_xlim(), [-0.6, 0.4])
    axes.plot([0, 10], [0, 10])
    axes.autoscale()
    assert np.allclose(axes.get_xlim(), [-0.6, 0.4])


def test_lines_are_finer_under_a_zoom():
    axes = axes_of(focus=PARIS)
    pixels(axes)
    whole, path = axes.transGlobe.tolerance, Path([(0, 40), (40, 60)])
    coarse = len(axes.transGlobe.transform_path(path).vertices)
    axes.set(xlim=(-0.1, 0.1), ylim=(-0.1, 0.1))
    pixels(axes)
    assert axes.transGlobe.tolerance == whole / 16
    assert len(axes.transGlobe.transform_path(path).vertices) == pytest.approx(4 * coarse, rel=0.3)


def test_zoom_to_a_box_of_degrees():
    axes = axes_of(view=(0, 0))
    axes.zoom_to((-30, -30, 30, 30))
    half = np.sin(np.radians(30))
    assert np.allclose([*axes.get_xlim(), *axes.get_ylim()], [-half, half, -half, half], atol=1e-4)
    axes.set_global()
    assert axes.get_xlim() == (-1, 1)
    axes.zoom_to(np.array([-180, -90, 180, 90]))
    assert np.allclose([*axes.get_xlim(), *axes.get_ylim()], [-1, 1, -1, 1], atol=1e-4)
    axes.zoom_to(shapely.box(-100, 20, 100, 40).bounds)
    assert axes.get_xlim()[0] < -0.9
    assert axes.get_ylim()[0] == pytest.approx(np.sin(np.radians(20)), abs=1e-4)
    with pytest.raises(ValueError, match="are not visible"):
        axes.zoom_to((170, -5, 190, 5))
    with pytest.raises(ValueError, match="bounds runs from longitude 30 to -30"):
        axes.zoom_to((30, -30, -30, 30))


@pytest.mark.parametrize(
    ("limits", "share"), [((-1, 1), np.pi / 4), ((-0.5, 0.5), 1.0), ((0, 2), np.pi / 16)], ids=["all", "inner", "cut"]
)
def test_the_frame_is_the_limb_or_the_limits(limits, share):
    """What fills the disc fills the axes only as far as the disc does."""
    axes = axes_of(facecolor="red")
    axes.set(xlim=limits, ylim=limits)
    axes.set_position((0, 0, 1, 1))
    axes.spines["limb"].set_visible(False)
    assert (pixels(axes) == (255, 0, 0)).all(axis=2).mean() == pytest.approx(share, abs=0.02)


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_files(tmp_path, kind):
    axes = axes_of(focus=PARIS, magnification=4)
    axes.set_title("S = 4")
    axes.coastlines("110m")
    axes.grid(True)
    axes.fill([-10, 30, 30, -10], [30, 30, 60, 60], alpha=0.3)
    axes.plot([2.35, -74], [48.86, 40.7], label="way")
    axes.text(174, -41, "behind")
    axes.legend()
    axes.figure.tight_layout()
    axes.figure.savefig(tmp_path / f"globe.{kind}", bbox_inches="tight")
    assert (tmp_path / f"globe.{kind}").stat().st_size > 5000
