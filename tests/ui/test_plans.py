from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from PySide6.QtCore import QMimeData, QUrl
from PySide6.QtGui import QColor, QImage

from bobdesk.errors import InputError
from bobdesk.files.importers.formats import read_line
from bobdesk.project import edits
from bobdesk.project.project import Picture, Project
from bobdesk.ui.plans import Plans

SAMPLES = Path(__file__).parent.parent.parent / "resources" / "samples"


@pytest.fixture
def looked():
    return []


@pytest.fixture
def plans(desk, documents, answers, looked, window):
    def look(path, as_actual):
        looked.append(path)
        try:
            return read_line(path), True
        except InputError:
            return None

    return Plans(desk, documents, answers, look, window)


@pytest.fixture
def drawing(tmp_path):
    path = tmp_path / "igls.png"
    Image.fromarray(np.full((60, 80), 200, np.uint8)).save(path, dpi=(300, 300))
    return path


def test_a_picture_becomes_a_project(plans, desk, drawing, until):
    plans.open_any(drawing)
    until(lambda: desk.picture.image is not None)
    picture = desk.session.project.picture
    assert picture.size_px == (80, 60)
    assert picture.data == drawing.read_bytes()
    assert picture.file_dpi == pytest.approx((300, 300), abs=0.1)
    assert desk.session.project.name == "igls"
    assert (desk.picture.image.width, desk.picture.image.height) == (80, 60)
    assert desk.session.undo_label == "Open igls.png"


def test_undo_and_redo_show_the_picture_without_reading_it_again(plans, desk, drawing, until):
    plans.open_any(drawing)
    until(lambda: desk.picture.image is not None)
    image = desk.picture.image
    desk.session.undo()
    assert desk.picture.image is None
    desk.session.redo()
    assert desk.picture.image is image
    assert desk.picture.job is None


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("empty.png", b""),
        ("words.png", b"these are words"),
        ("cut.png", b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x00"),
        ("cut.bobdesk", b"PK\x03\x04"),
    ],
)
def test_what_cannot_be_read_says_so_and_changes_nothing(plans, desk, tmp_path, until, said, name, content, looked):
    path = tmp_path / name
    path.write_bytes(content)
    before = desk.session.project
    plans.open_any(path)
    until(lambda: bool(said))
    assert desk.session.project is before
    assert looked == []
    assert name in said[0]


def test_missing_file_and_folder_are_sentences(plans, desk, tmp_path, said):
    plans.open_any(tmp_path / "gone.png")
    plans.open_any(tmp_path)
    assert len(said) == 2
    assert "gone.png" in said[0]
    assert not desk.session.is_open


def test_second_plan_asks_where_it_belongs(plans, desk, answers, drawing, tmp_path, until):
    plans.open_any(drawing)
    until(lambda: desk.picture.image is not None)
    before = desk.session.project
    other = tmp_path / "other.png"
    Image.fromarray(np.full((40, 40), 10, np.uint8)).save(other)
    plans.open_any(other)
    until(lambda: answers.asked == ["where to put the plan"])
    assert desk.session.project is before
    answers.plan_answer = "replace"
    plans.open_any(other)
    until(lambda: desk.session.project.picture.name == "other.png")
    desk.session.undo()
    assert desk.session.project is before
    answers.plan_answer, answers.save_answer = "new", "discard"
    plans.open_any(other)
    until(lambda: desk.session.project.picture.name == "other.png")
    assert desk.session.project.name == "other"


def test_pasted_picture_is_kept_without_loss(plans, desk, until):
    image = QImage(30, 20, QImage.Format.Format_RGB32)
    image.fill(QColor(10, 200, 30))
    mime = QMimeData()
    mime.setImageData(image)
    plans.paste(mime)
    until(lambda: desk.picture.image is not None)
    assert desk.picture.image.pixels.shape == (20, 30, 3)
    assert desk.picture.image.pixels[5, 5].tolist() == [10, 200, 30]
    assert desk.picture.image.dpi is None


def test_pasted_file_is_opened_and_text_is_not(plans, desk, drawing, until, said):
    mime = QMimeData()
    mime.setText("a word")
    plans.paste(mime)
    assert "clipboard" in said[0]
    mime = QMimeData()
    mime.setUrls([QUrl.fromLocalFile(str(drawing))])
    plans.paste(mime)
    until(lambda: desk.picture.image is not None)


def test_coordinates_bring_elevations_for_comparison(plans, desk):
    plans.open_any(SAMPLES / "mugello" / "mugello.csv")
    project = desk.session.project
    assert project.source.name == "mugello.csv"
    assert project.actual.points.shape == (len(project.source.polyline.vertices), 3)


def test_comparison_needs_elevations(plans, desk, answers, tmp_path, said):
    flat = tmp_path / "flat.csv"
    flat.write_text("x_m,y_m\n0,0\n10,0\n20,5\n")
    plans.open_coordinates(SAMPLES / "mugello" / "mugello.csv")
    desk.session.apply("Compare with nothing", edits.compare_with_nothing)
    answers.open_path = flat
    plans.compare_with_file()
    assert desk.session.project.actual is None
    assert "no elevations" in said[-1]
    answers.open_path = SAMPLES / "mugello" / "mugello.csv"
    plans.compare_with_file()
    assert desk.session.project.actual.name == "mugello.csv"


def test_plan_does_not_land_unasked_in_a_project_that_was_opened_meanwhile(
    plans, desk, documents, answers, drawing, until
):
    documents.begin()
    plans.open_picture(drawing)
    documents.begin()
    until(lambda: desk.runner.jobs == ())
    assert answers.asked == ["where to put the plan"]
    assert desk.session.project.picture is None


def test_stopped_reading_of_a_project_s_picture_says_so(desk, drawing, until):
    desk.session.open(Project(picture=Picture(drawing.read_bytes(), "igls.png")), None)
    desk.picture.job.stop()
    until(lambda: desk.picture.problem is not None)
    assert "stopped" in desk.picture.problem
