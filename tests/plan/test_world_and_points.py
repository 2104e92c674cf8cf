import pytest

from bobdesk.errors import InputError
from bobdesk.plan.control_points import ControlPoint
from bobdesk.plan.geotiff import geotiff_world
from bobdesk.plan.qgis_points import format_qgis_points, parse_qgis_points
from bobdesk.plan.world import PixelToWorld, turned_world
from bobdesk.plan.world_file import format_world_file, parse_world_file, world_file_names

NEW = """#CRS: PROJCRS["ETRS89 / UTM zone 32N"]
mapX,mapY,sourceX,sourceY,enable,dX,dY,residual
682000.5,5234000.25,10.5,-20.5,1,0.1,0.2,0.22
682100,5234000,210.5,-20.5,0,0,0,0
"""
OLD = "mapX,mapY,pixelX,pixelY,enable\n1.5,2.5,0.5,-0.5,1\n3,4,100,-200,0\n"


def test_the_new_points_format_counts_from_the_pixels_corner():
    read = parse_qgis_points(NEW, name="a.points")
    assert read.crs.startswith("PROJCRS")
    assert read.points == (
        ControlPoint(10, 20, 682000.5, 5234000.25, "1", True),
        ControlPoint(210, 20, 682100, 5234000, "2", False),
    )


def test_the_old_points_format():
    read = parse_qgis_points(OLD, name="a.points")
    assert read.crs == ""
    assert read.points == (
        ControlPoint(0, 0, 1.5, 2.5, "1", True),
        ControlPoint(99.5, 199.5, 3, 4, "2", False),
    )


def test_the_oldest_points_are_separated_by_tabs_without_enable():
    read = parse_qgis_points("mapX\tmapY\tpixelX\tpixelY\n1\t2\t3.5\t-4.5\n", name="a.points")
    assert read.points == (ControlPoint(3, 4, 1, 2, "1", True),)


def test_points_survive_writing_and_reading():
    points = (ControlPoint(0.1, 0.2, 682000.123456789, 5.0, "1"), ControlPoint(3, 4, -5, 6, "2", False))
    text = format_qgis_points(points, crs="EPSG:25832")
    assert text.splitlines()[:2] == ["#CRS: EPSG:25832", "mapX,mapY,sourceX,sourceY,enable,dX,dY,residual"]
    read = parse_qgis_points(text, name="a.points")
    assert read.crs == "EPSG:25832"
    for before, after in zip(points, read.points, strict=True):
        assert (after.x_m, after.y_m, after.used) == (before.x_m, before.y_m, before.used)
        assert (after.x_px, after.y_px) == pytest.approx((before.x_px, before.y_px), abs=1e-12)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no line that names the columns"),
        ("x,y\n1,2\n", "line 1"),
        ("mapX,mapY,sourceX,sourceY,enable\n1,2,3\n", "line 2"),
        ("mapX,mapY,sourceX,sourceY,enable\n1,2,3,-4,1\n1,2,x,-4,1\n", "line 3"),
        ("mapX,mapY,sourceX,sourceY,enable\n1,2,nan,-4,1\n", "line 2"),
        ("mapX,mapY,sourceX,sourceY,enable\n1,2,3,-4,1e999\n", "line 2"),
        ("#CRS: EPSG:4326\nmapX,mapY,sourceX,sourceY\n8.1,47.2,3,-4\n", "degrees"),
        ('#CRS: GEOGCRS["WGS 84"]\nmapX,mapY,sourceX,sourceY\n8.1,47.2,3,-4\n', "degrees"),
        ("#CRS: EPSG:3857\nmapX,mapY,sourceX,sourceY\n8.1,47.2,3,-4\n", "Web Mercator"),
        ("mapX,mapY,sourceX,sourceY\n1,2,682000,5234000\n1,9,682009,5234008\n", "counts upwards"),
    ],
)
def test_bad_points_files_say_what_and_where(text, words):
    with pytest.raises(InputError, match=words) as caught:
        parse_qgis_points(text, name="a.points")
    assert "a.points" in str(caught.value)


def test_world_file_lines_stand_in_esris_order():
    world = parse_world_file("0.3\n0.4\n0.5\n-0.6\n1000,25\n2000\n", name="a.pgw")
    assert world == PixelToWorld(0.3, 0.5, 1000.25, 0.4, -0.6, 2000)
    assert parse_world_file(format_world_file(world), name="a.pgw") == world
    assert world.at(0, 0) == (1000.25, 2000)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "0 lines"),
        ("1\n0\n0\n-1\n5\n", "5 lines"),
        ("1\n0\nzero\n-1\n5\n5\n", "line 3"),
        ("nan\n0\n0\n-1\n5\n5\n", "out of range"),
        ("0\n0\n0\n0\n5\n5\n", "no area"),
        ("1\n1\n1\n1\n5\n5\n", "no area"),
        ("0.00001\n0\n0\n-0.00001\n11.5\n47.2\n", "degrees"),
    ],
)
def test_bad_world_files_say_what(text, words):
    with pytest.raises(InputError, match=words) as caught:
        parse_world_file(text, name="a.pgw")
    assert "a.pgw" in str(caught.value)


@pytest.mark.parametrize(
    ("picture", "beside"),
    [
        ("plan.png", "plan.pgw"),
        ("plan.tif", "plan.TFW"),
        ("plan.tiff", "plan.tfw"),
        ("plan.jpg", "plan.jgw"),
        ("plan.jpeg", "plan.jgw"),
        ("a.b.png", "a.b.pngw"),
        ("plan.png", "plan.wld"),
        ("plan", "plan.wld"),
    ],
)
def test_world_file_names(picture, beside):
    assert beside in world_file_names(picture)


def keys(**values):
    numbers = {"model": 1024, "raster": 1025, "system": 3072, "unit": 3076}
    entries = [(numbers[key], 0, 1, value) for key, value in values.items()]
    return (1, 1, 0, len(entries), *(number for entry in entries for number in entry))


SCALE_AND_TIE = {33550: (0.5, 0.5, 0.0), 33922: (0.0, 0.0, 0.0, 1000.0, 2000.0, 0.0)}


def test_geotiff_counts_from_the_corner_unless_pixel_is_point():
    assert geotiff_world(SCALE_AND_TIE, name="a").at(0, 0) == (1000.25, 1999.75)
    assert geotiff_world({**SCALE_AND_TIE, 34735: keys(raster=1)}, name="a").at(0, 0) == (1000.25, 1999.75)
    assert geotiff_world({**SCALE_AND_TIE, 34735: keys(raster=2)}, name="a").at(0, 0) == (1000, 2000)


def test_geotiff_tie_point_elsewhere_and_transformation():
    tags = {33550: (0.5, 0.5, 0), 33922: (10, 20, 0, 1000, 2000, 0)}
    world = geotiff_world(tags, name="a")
    assert world.at(9.5, 19.5) == pytest.approx((1000, 2000))
    matrix = (0.3, 0.4, 0, 1000, 0.4, -0.3, 0, 2000, 0, 0, 0, 0, 0, 0, 0, 1)
    world = geotiff_world({34264: matrix, 34735: keys(raster=2)}, name="a")
    assert world == PixelToWorld(0.3, 0.4, 1000, 0.4, -0.3, 2000)


def test_geotiff_in_feet():
    world = geotiff_world({**SCALE_AND_TIE, 34735: keys(unit=9002, raster=2)}, name="a")
    assert world.x_per_column == pytest.approx(0.1524)
    assert world.x_origin == pytest.approx(304.8)


def test_tiff_without_a_place_has_none():
    assert geotiff_world({}, name="a") is None
    assert geotiff_world({33550: (1, 1, 0)}, name="a") is None


@pytest.mark.parametrize(
    ("tags", "words"),
    [
        ({**SCALE_AND_TIE, 34735: keys(model=2)}, "degrees"),
        ({**SCALE_AND_TIE, 34735: keys(system=3857)}, "Web Mercator"),
        ({**SCALE_AND_TIE, 34735: keys(unit=9999)}, "unit"),
        ({33550: (0.5,), 33922: (0, 0)}, "no sense"),
        ({33550: (0.5, 0.5, 0), 33922: (0, 0, 0, float("nan"), 0, 0)}, "no sense"),
        ({34264: (1, 2, 3)}, "no sense"),
        ({33550: ("a", "b", "c"), 33922: (0, 0, 0, 1, 0, 0)}, "no sense"),
        ({33550: (0.0, 0.0, 0), 33922: (0, 0, 0, 1, 0, 0)}, "no area"),
    ],
)
def test_geotiff_that_cannot_be_used_says_why(tags, words):
    with pytest.raises(InputError, match=words):
        geotiff_world(tags, name="a.tif")


@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_turned_picture_keeps_its_place(orientation):
    import numpy as np
    from PIL import Image, ImageOps

    stored = np.arange(12, dtype=np.uint8).reshape(3, 4)
    picture = Image.fromarray(stored)
    picture.getexif()[0x0112] = orientation
    turned = np.asarray(ImageOps.exif_transpose(picture))
    world = PixelToWorld(0.3, 0.4, 1000, 0.4, -0.3, 2000)
    after = turned_world(world, orientation=orientation, width=4, height=3)
    for value in range(12):
        (row, column), (y, x) = np.argwhere(stored == value)[0], np.argwhere(turned == value)[0]
        assert after.at(x, y) == pytest.approx(world.at(column, row))
