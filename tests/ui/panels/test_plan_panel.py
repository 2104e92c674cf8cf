import io

import pytest
from PIL import Image
from PySide6.QtWidgets import QPushButton

from bobdesk.project import edits
from bobdesk.project.project import Picture, Project
from bobdesk.ui.panels.plan_panel import PlanPanel
from tests.plan.made_pdf import made_pdf
from tests.project.made_projects import coordinates_project, full_project


@pytest.fixture
def panel(desk, qtbot):
    panel = PlanPanel(desk)
    qtbot.addWidget(panel)
    panel.resize(440, 900)
    panel.show()
    return panel


def svg(width=40, height=20):
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" viewBox="0 0 40 20">'
        '<path d="M2 10 L38 12" stroke="black" fill="none"/></svg>'
    ).encode()


def tiff(pages):
    images = [Image.new("L", (60 + 10 * page, 40), 255) for page in range(pages)]
    stream = io.BytesIO()
    images[0].save(stream, "TIFF", save_all=True, append_images=images[1:])
    return stream.getvalue()


@pytest.fixture
def drawing(desk, idle):
    project = edits.open_picture(Project(), Picture(svg(), "plan.svg", dpi=200.0, size_px=(315, 157)))
    project = edits.draw_line(project, [(10, 10), (100, 60), (200, 80), (300, 90)])
    desk.session.open(project, None)
    idle()
    return project


def test_name_and_notes_are_one_step_each(desk, opened, panel, qtbot):
    panel.name.setFocus()
    qtbot.keyClicks(panel.name, "Igls old ")
    assert desk.session.project.name == "Igls old"
    qtbot.keyClicks(panel.name, "town")
    assert desk.session.project.name == "Igls old town"
    panel.notes.setPlainText("one")
    panel.notes.appendPlainText("two")
    assert desk.session.project.notes == "one\ntwo"
    desk.session.undo()
    assert panel.notes.toPlainText() == ""
    desk.session.undo()
    assert panel.name.text() == ""
    assert desk.session.project is opened


def test_properties_of_a_picture(desk, panel, idle):
    stream = io.BytesIO()
    Image.new("L", (300, 200), 255).save(stream, "PNG", dpi=(300, 300))
    desk.session.open(edits.open_picture(Project(), Picture(stream.getvalue(), "plan.png")), None)
    idle()
    part = panel.source
    assert part.format.text() == "PNG"
    assert part.pixels.text() == "300 × 200 px, 0.1 megapixels"
    assert part.resolution.text() == "300 dpi"
    assert part.position.text() == "not stated"
    assert not part.pages.isVisible()
    assert not panel.page.isVisible()


def test_a_picture_that_cannot_be_read_says_why(desk, opened, panel, idle):
    idle()
    assert panel.source.problem.isVisible()
    assert panel.source.problem.text()


def test_properties_of_coordinates(desk, panel):
    desk.session.open(coordinates_project(), None)
    part = panel.source
    assert part.vertices.text() == "300"
    assert "12.98" in part.position.text()
    assert part.length.text().endswith(" m")
    assert not part.pixels.isVisible()


def test_another_resolution_keeps_everything_in_place(desk, drawing, panel, until):
    assert panel.page.dpi.isVisible()
    panel.page.dpi.setValue(400)
    until(lambda: desk.session.project is not drawing)
    picture = desk.session.project.picture
    assert picture.dpi == 400
    assert picture.size_px == (desk.picture.image.width, desk.picture.image.height)
    factor = picture.size_px[0] / drawing.picture.size_px[0]
    expected = (drawing.trace.points + 0.5) * factor - 0.5
    assert desk.session.project.trace.points == pytest.approx(expected)
    desk.session.undo()
    assert desk.session.project is drawing
    assert panel.page.dpi.value() == 200


def test_a_page_too_large_is_refused_in_a_sentence(desk, panel, told, idle):
    desk.session.open(edits.open_picture(Project(), Picture(svg(4000, 2000), "plan.svg", dpi=20.0)), None)
    idle()
    before = desk.session.project
    panel.page.dpi.setValue(2400)
    idle()
    assert desk.session.project is before
    assert panel.page.dpi.value() == 20
    assert len(told) == 1
    assert "dpi" in told[0]


def test_another_page_is_opened_at_once_where_nothing_was_placed(desk, panel, idle):
    desk.session.open(edits.open_picture(Project(), Picture(tiff(3), "plan.tif", size_px=(60, 40))), None)
    idle()
    assert panel.page.page.isVisible()
    assert not panel.page.dpi.isVisible()
    panel.page.page.setValue(2)
    idle()
    assert desk.session.project.picture.page == 2
    assert desk.session.project.picture.size_px == (70, 40)


def test_another_page_asks_before_it_puts_a_line_away(desk, panel, idle):
    project = edits.open_picture(Project(), Picture(tiff(3), "plan.tif", size_px=(60, 40)))
    project = edits.draw_line(project, [(1, 1), (20, 20), (50, 30)])
    desk.session.open(project, None)
    idle()
    notices = []
    desk.notices.told.connect(notices.append)
    panel.page.page.setValue(3)
    idle()
    assert desk.session.project is project
    assert panel.page.page.value() == 1
    notices[0].remedies[0].do()
    idle()
    assert desk.session.project.picture.page == 3
    assert desk.session.project.trace is None
    desk.session.undo()
    assert desk.session.project is project


def test_another_document_meanwhile_is_left_alone(desk, drawing, panel, idle):
    panel.page.dpi.setValue(400)
    other = coordinates_project()
    desk.session.open(other, None)
    idle()
    assert desk.session.project is other


def test_which_line_was_digitised(desk, opened, panel):
    part = panel.digitised
    part.line.setCurrentIndex(1)
    part.line.activated.emit(1)
    assert desk.session.project.extent.digitised == "left edge"
    assert part.offset.isVisible()
    part.offset.setValue(0.7)
    part.offset.setValue(0.75)
    assert desk.session.project.extent.offset == pytest.approx(0.75)
    desk.session.undo()
    desk.session.undo()
    assert desk.session.project is opened


def test_the_actual_track(desk, panel):
    project = full_project()
    desk.session.open(project, None)
    assert "actual.csv" in panel.actual.what.text()
    panel.actual.remove_button.click()
    assert desk.session.project.actual is None
    desk.session.undo()
    assert desk.session.project is project


def test_buttons_ask_for_files(desk, panel):
    asked = []
    panel.picture_wanted.connect(lambda: asked.append("picture"))
    panel.coordinates_wanted.connect(lambda: asked.append("coordinates"))
    panel.comparison_wanted.connect(lambda: asked.append("comparison"))
    assert "Nothing is open" in panel.state.text()
    for button in panel.findChildren(QPushButton):
        if button.isVisible():
            button.click()
    panel.actual.wanted.emit()
    assert asked == ["picture", "coordinates", "comparison"]


def test_a_pdf_has_a_resolution(desk, panel, idle):
    page = made_pdf(["10 10 m 90 20 l S"], width=100, height=50)
    desk.session.open(edits.open_picture(Project(), Picture(page, "plan.pdf", dpi=100.0)), None)
    idle()
    assert panel.source.format.text() == "PDF"
    assert panel.page.dpi.isVisible()
