"""The guide's window: opened where one is, read with mouse and keys, searched, in both themes."""

import subprocess
import sys

import pytest
from PySide6.QtCore import QPoint, Qt, QUrl
from PySide6.QtGui import QAccessible, QColor, QDesktopServices, QTextDocument
from PySide6.QtWidgets import QApplication, QToolButton, QWidget

from bobdesk.files.project_file import load_project
from bobdesk.ui.guide.find import GuideFinder, words_of
from bobdesk.ui.guide.guide_window import GuideWindow
from bobdesk.ui.guide.pages import Page, keep_units, read_pages, slug
from bobdesk.ui.questions import Questions
from bobdesk.ui.resources import resource
from bobdesk.ui.settings import Settings
from bobdesk.ui.theme import apply_theme, colours

ALT, SHIFT = Qt.KeyboardModifier.AltModifier, Qt.KeyboardModifier.ShiftModifier
CTRL, NONE = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.NoModifier


@pytest.fixture
def pages():
    return read_pages(resource("guide"), {"keys": lambda: "| Action | Key |\n|---|---|\n| Save | `Ctrl+S` |"})


@pytest.fixture
def guide(qtbot, pages, tmp_path):
    made = GuideWindow(pages, resource("guide"), Settings(tmp_path / "settings.ini"))
    made.show()
    qtbot.waitExposed(made)
    yield made
    made.close()
    made.deleteLater()


def listed(guide):
    return [guide.contents.list.item(row).text() for row in range(guide.contents.list.count())]


def top_block(guide):
    return guide.browser.cursorForPosition(QPoint(60, 12)).block().text()


def test_it_begins_with_its_first_page_and_lists_all_of_them(guide, pages):
    assert guide.browser.page.name == "index.md"
    assert guide.browser.verticalScrollBar().value() == 0
    assert [title for title in listed(guide) if title in {page.title for page in pages}] == [
        page.title for page in pages
    ]
    assert guide.contents.list.currentItem().text() == pages[0].title
    assert not guide.back_action.isEnabled()


def test_links_headings_back_and_forward(qtbot, guide):
    guide.go_to("solve.md#known-elevations")
    qtbot.waitUntil(lambda: "Known elevations" in top_block(guide))
    guide.browser.link_followed.emit("what-the-data-leave-open.md")
    assert guide.browser.page.name == "what-the-data-leave-open.md"
    assert guide.contents.list.currentItem().text() == "What the data leave open"
    guide.back()
    assert guide.browser.page.name == "solve.md"
    assert "Known elevations" in top_block(guide)
    guide.back()
    assert guide.browser.page.name == "index.md"
    assert not guide.back_action.isEnabled()
    guide.forward()
    guide.forward()
    assert guide.browser.page.name == "what-the-data-leave-open.md"
    assert not guide.forward_action.isEnabled()


def test_a_heading_stays_at_the_top_while_the_window_changes_its_size(qtbot, guide):
    guide.go_to("solve.md#known-elevations")
    guide.resize(640, 500)
    qtbot.waitUntil(lambda: "Known elevations" in top_block(guide))
    guide.resize(1200, 700)
    qtbot.waitUntil(lambda: "Known elevations" in top_block(guide))


def test_a_link_to_the_network_opens_in_the_browser_and_nothing_else_does(guide, monkeypatch):
    opened = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(url.toString()))
    guide.browser.link_followed.emit("https://arxiv.org/abs/2507.08393")
    guide.browser.link_followed.emit("file:///etc/passwd")
    guide.browser.link_followed.emit("nowhere.md")
    assert opened == ["https://arxiv.org/abs/2507.08393"]
    assert guide.browser.page.name == "index.md"


def test_search_in_all_pages_by_keys(qtbot, guide):
    qtbot.keyClick(guide, Qt.Key.Key_F, CTRL)
    assert guide.contents.search.hasFocus()
    qtbot.keyClicks(guide.contents.search, "decimal comma")
    assert guide.contents.found.isVisible()
    hits = len(listed(guide))
    assert hits >= 2
    qtbot.keyClick(guide.contents.search, Qt.Key.Key_Return)
    first = guide.browser.page.name
    assert guide.browser.extraSelections()
    assert all(one.cursor.selectedText().casefold() in ("decimal", "comma") for one in guide.browser.extraSelections())
    for _ in range(hits):
        qtbot.keyClick(guide, Qt.Key.Key_F3)
    assert guide.browser.page.name == first
    qtbot.keyClick(guide, Qt.Key.Key_F3, SHIFT)
    assert guide.contents.list.currentRow() == hits - 1
    qtbot.keyClick(guide.contents.search, Qt.Key.Key_Escape)
    assert listed(guide)[0] == "BobDesk user's guide"
    assert not guide.browser.extraSelections()
    assert guide.isVisible()
    qtbot.keyClicks(guide.contents.search, "qwertz")
    assert listed(guide) == []
    assert "Nothing found" in guide.contents.found.text()


def test_what_was_found_is_in_sight(qtbot, guide):
    guide.contents.search.setText("LOCALAPPDATA")
    guide.contents.go_by(1)
    assert guide.browser.page.name == "questions.md"
    assert guide.browser.viewport().rect().contains(guide.browser.cursorRect().center())


def test_finding_takes_all_words_in_a_paragraph_and_headings_first():
    finder = GuideFinder((Page("a.md", "A", "", "# A\n\nThe **known** elevation.\n\n## Known elevation\n\nknown"),))
    found = finder.find(words_of("Known elevation x"))
    assert [(hit.heading, hit.excerpt) for hit in found] == [
        ("Known elevation", "Known elevation"),
        ("A", "The known elevation."),
    ]
    assert finder.find(words_of("x")) == ()


def test_zoom_by_keys(qtbot, guide):
    guide.go_to("first-track.md")
    before = guide.browser.document().size().height()
    qtbot.keyClick(guide, Qt.Key.Key_Plus, CTRL)
    qtbot.keyClick(guide, Qt.Key.Key_Plus, CTRL)
    assert guide.browser.document().size().height() > before
    qtbot.keyClick(guide, Qt.Key.Key_0, CTRL)
    assert guide.browser.document().size().height() == pytest.approx(before, rel=0.01)
    for _ in range(20):
        guide.zoom_by(-1)
    assert guide.browser.text_size > 5


def test_pictures_are_never_wider_than_the_page_and_sharp(qtbot, guide):
    guide.go_to("first-track.md")
    for width in (1200, 700, 520):
        guide.resize(width, 700)
        qtbot.waitUntil(lambda: guide.browser.horizontalScrollBar().maximum() == 0)
        image = guide.browser.document().resource(
            QTextDocument.ResourceType.ImageResource.value, QUrl("pictures/first-run.png")
        )
        assert 0 < image.width() <= guide.browser.viewport().width() * guide.devicePixelRatioF()


def test_the_other_theme_is_taken_over_at_once(qtbot, qapp, guide):
    def ground():
        image = guide.browser.viewport().grab().toImage()
        return image.pixelColor(image.width() - 3, image.height() - 3).name()

    assert ground() == QColor(colours().base).name()
    apply_theme(qapp, "dark")
    qtbot.waitUntil(lambda: ground() == QColor(colours().base).name())
    assert QColor(ground()).lightness() < 60
    links = [
        piece
        for block in blocks(guide.browser.document())
        for piece in fragments(block)
        if piece.charFormat().isAnchor()
    ]
    assert links
    assert {piece.charFormat().foreground().color().name() for piece in links} == {QColor(colours().accent).name()}


def blocks(document):
    block = document.begin()
    while block.isValid():
        yield block
        block = block.next()


def fragments(block):
    at = block.begin()
    while not at.atEnd():
        yield at.fragment()
        at += 1


def test_every_control_has_a_name_and_the_keyboard_reaches_it(qtbot, guide):
    guide.back_action.setEnabled(True)
    guide.forward_action.setEnabled(True)
    reached = set()
    guide.contents.search.setFocus()
    for _ in range(30):
        focus = QApplication.focusWidget()
        reached.add(focus)
        assert QAccessible.queryAccessibleInterface(focus).text(QAccessible.Text.Name)
        qtbot.keyClick(focus, Qt.Key.Key_Tab, NONE)
    buttons = [one for one in guide.findChildren(QToolButton) if one.isVisible() and one.defaultAction() is not None]
    assert len(buttons) == 6
    assert {guide.contents.search, guide.contents.list, guide.browser, *buttons} <= reached
    guide.contents.search.setFocus()
    qtbot.keyClick(guide, Qt.Key.Key_F6)
    assert guide.browser.hasFocus()
    qtbot.keyClick(guide, Qt.Key.Key_F6)
    assert guide.contents.list.hasFocus()


def test_the_whole_guide_as_pdf(qtbot, guide, monkeypatch, tmp_path):
    import pypdfium2

    path = tmp_path / "guide.pdf"
    monkeypatch.setattr(Questions, "file_to_save", lambda *_arguments: path)
    guide.save_as_pdf()
    document = pypdfium2.PdfDocument(path)
    sheets = [document[index].get_textpage().get_text_bounded() for index in range(len(document))]
    pictures = sum(1 for index in range(len(document)) for one in document[index].get_objects() if one.type == 3)
    document.close()
    assert len(sheets) >= 14
    assert "user’s guide" in sheets[0] or "user's guide" in sheets[0]
    assert any(sheet.startswith("First track in ten minutes") for sheet in sheets)
    assert any("mean_gradient_drop_per_length" in sheet for sheet in sheets)
    assert pictures >= 17
    assert "Written to guide.pdf." in guide.statusBar().currentMessage()


def test_a_pdf_that_cannot_be_written_is_said(guide, monkeypatch, tmp_path):
    monkeypatch.setattr(Questions, "file_to_save", lambda *_arguments: tmp_path / "none" / "guide.pdf")
    guide.save_as_pdf()
    assert "guide.pdf" in guide.statusBar().currentMessage()


def test_esc_and_ctrl_w_close_it_and_its_size_is_kept(qtbot, guide, pages):
    guide.resize(640, 510)
    qtbot.keyClick(guide.browser, Qt.Key.Key_Escape)
    assert not guide.isVisible()
    other = GuideWindow(pages, resource("guide"), guide._settings)
    assert (other.width(), other.height()) == (640, 510)
    other.show()
    other.activateWindow()
    qtbot.waitUntil(other.isActiveWindow)
    qtbot.keyClick(other, Qt.Key.Key_W, CTRL)
    assert not other.isVisible()
    other.deleteLater()


def test_f1_opens_the_page_of_what_one_does(qtbot, window):
    def page():
        return window.guide.window.browser.page.name

    window.actions_by_name["guide"].trigger()
    assert page() == "index.md"
    window.actions_by_name["first_track"].trigger()
    assert page() == "first-track.md"
    window.documents.begin()
    window.desk.session.apply("load", lambda _project: load_project(resource("samples", "mugello", "mugello.bobdesk")))
    for step, expected in (("Scale", "scale.md"), ("Segments", "segments.md"), ("Export", "export.md")):
        window.go_to(step)
        window.view.setFocus()
        window.actions_by_name["guide"].trigger()
        assert page() == expected


def test_f1_opens_the_heading_of_the_part_in_focus(qtbot, window):
    from bobdesk.ui.guide.context import place_in_guide

    window.documents.begin()
    window.desk.session.apply("load", lambda _project: load_project(resource("samples", "mugello", "mugello.bobdesk")))
    window.go_to("Solve")
    field = next(one for one in window.findChildren(QWidget) if one.accessibleName() == "Length (3D)")
    assert place_in_guide(field, "Solve") == "solve.md#what-is-known-of-the-track"
    assert place_in_guide(window.layout_of_window.strips_dock.widget(), "Solve") == "segments.md#strips-by-station"
    assert place_in_guide(None, "Plan") == "plan.md"
    assert place_in_guide(None, None) == "index.md"


@pytest.mark.parametrize(
    ("name", "place"),
    [("methods", "Compare methods"), ("study", "Study"), ("published", "Published tables")],
)
def test_f1_acts_in_the_windows_beside_the_main_one(qtbot, window, name, place):
    beside = window.beside.open(name)
    beside.activateWindow()
    qtbot.waitUntil(beside.isActiveWindow)
    qtbot.keyClick(beside, Qt.Key.Key_F1)
    qtbot.waitUntil(lambda: window.guide.window is not None)
    assert window.guide.window.browser.page.name == "compare.md"
    assert window.guide.window.browser.textCursor().block().text() == place
    beside.close()


def test_the_page_of_keys_shows_those_in_force(qtbot, window):
    window.desk.settings.set_key("save", "Ctrl+Alt+S")
    window.guide.open("keys.md")
    text = window.guide.window.browser.toPlainText()
    assert "Ctrl+Alt+S" in text
    assert "{{" not in text
    window.guide.window.close()
    window.desk.settings.set_key("save", None)
    window.guide.open("keys.md")
    assert "Ctrl+Alt+S" not in window.guide.window.browser.toPlainText()


def test_it_goes_with_the_programs_window(qtbot, window):
    window.guide.open("index.md")
    guide = window.guide.window
    assert guide.isVisible()
    window.leave()
    assert not guide.isVisible()


def test_the_practice_picture_begins_a_project(qtbot, window):
    window.actions_by_name["practice_picture"].trigger()
    qtbot.waitUntil(lambda: window.desk.session.is_open and window.desk.session.project.picture is not None)
    assert window.desk.session.project.name == "Practice"
    qtbot.waitUntil(lambda: not window.desk.runner.jobs)


def test_a_missing_guide_is_said(qtbot, window, monkeypatch, tmp_path):
    from bobdesk.ui.guide import guide as module

    said = []
    window.desk.notices.told.connect(lambda notice: said.append(notice.sentence))
    monkeypatch.setattr(module, "resource", lambda *_parts: tmp_path)
    window.guide.open("index.md")
    assert said == ["The guide is missing from this installation of BobDesk; install it again."]


def test_a_number_and_its_unit_stay_on_one_line():
    assert keep_units("0.1 is 10 %. 8 m, 3 known") == "0.1 is 10\u00a0%. 8\u00a0m, 3 known"


def test_names_of_headings_in_links():
    assert slug("Which line was drawn?") == "which-line-was-drawn"
    assert slug("1 Plan") == "1-plan"


def test_the_guide_is_not_loaded_before_it_is_opened():
    code = (
        "import sys, bobdesk.ui.main_window;"
        " print([name for name in sys.modules if name.startswith('bobdesk.ui.guide.')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60)
    loaded = set(ast_list(done.stdout))
    assert loaded == {"bobdesk.ui.guide.guide", "bobdesk.ui.guide.pages"}


def ast_list(text):
    import ast

    return ast.literal_eval(text.strip())
