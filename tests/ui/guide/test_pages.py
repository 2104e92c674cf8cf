"""What the pages of the guide say is so: names, keys, links, pictures, columns, words."""

import ast
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bobdesk.ui.guide.pages import read_pages, slug, split_link
from bobdesk.ui.main_window import MainWindow
from bobdesk.ui.settings import Settings

ROOT = Path(__file__).parents[3]
GUIDE = ROOT / "resources" / "guide"
PAGES = {page.name: page for page in read_pages(GUIDE, {"keys": lambda: ""})}
# Pages whose bold words are definitions.
DEFINES = ("words.md",)
_BOLD = re.compile(r"\*\*(.+?)\*\*", re.DOTALL)
_KEY = re.compile(r"^(?:(?:Ctrl|Shift|Alt)\+)*(?:F\d+|[A-Z0-9?\\,+=-]|Enter|Esc|Tab|Del|Space|Backspace|Left|Right|Home"
                  r"|Shift|Ctrl|Alt)$")  # fmt: skip
_WITH_KEY = re.compile(r"\*\*([^*]+?→[^*]+?)\*\*\s+\(`([^`]+)`\)")
# Keys that fields, tools and windows take themselves, with no row in the table of actions.
OF_WIDGETS = {
    *("Enter", "Esc", "Tab", "Space", "Backspace", "Shift", "Ctrl", "Alt", "F2", "1", "3", "7"),
    *("Ctrl+C", "Ctrl+F", "F3", "Alt+Left", "Alt+Right", "Alt+Home", "Ctrl++", "Ctrl+-", "Ctrl+0", "Ctrl+W", "F6"),
}


@pytest.fixture(scope="module")
def rows(qapp, tmp_path_factory):
    """The table of actions of a window."""
    home = tmp_path_factory.mktemp("home")
    window = MainWindow(Settings(home / "settings.ini"), home / "data")
    table = window.actions_by_name.table
    yield table
    window.leave()
    window.deleteLater()


@pytest.fixture(scope="module")
def words_on_screen():
    """Every text that the window can show: what stands in tr(…), without mnemonics and dots."""
    found = set()
    for path in (ROOT / "bobdesk" / "ui").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if (
                isinstance(node, ast.Call)
                and isinstance(node.func, ast.Attribute)
                and node.func.attr == "tr"
                and node.args
                and isinstance(node.args[0], ast.Constant)
            ):
                found.add(plain(node.args[0].value))
    from bobdesk.files.exporters.formats import FORMATS

    return found | {known.title for known in FORMATS}


def plain(text: str) -> str:
    return text.replace("&&", "\0").replace("&", "").replace("\0", "&").removesuffix("…").rstrip(":")


def one_line(text: str) -> str:
    return re.sub(r"\s+", " ", text)


def marked():
    """Every bold text with its page."""
    return [
        (page.name, one_line(text))
        for page in PAGES.values()
        if page.name not in DEFINES
        for text in _BOLD.findall(page.text)
    ]


def test_the_guide_lists_every_page_once():
    files = sorted(path.name for path in GUIDE.glob("*.md"))
    assert sorted(PAGES) == files
    assert [page.group for page in PAGES.values()].count("") == 1
    assert all(page.title for page in PAGES.values())


@pytest.mark.parametrize("page", sorted(PAGES))
def test_every_link_leads_somewhere_and_every_picture_is_there(page):
    text = PAGES[page].text
    for link in re.findall(r"(?<!!)\[[^\]]+\]\(([^)]+)\)", text):
        if link.startswith("https://"):
            continue
        name, heading = split_link(link)
        target = PAGES[name or page]
        headings = {slug(found) for found in re.findall(r"^#+ +(.+?)\s*$", target.text, re.MULTILINE)}
        assert not heading or heading in headings, link
    for words, picture in re.findall(r"!\[([^\]]*)\]\(([^)]+)\)", text):
        assert words, f"{picture} has no words for those who do not see it"
        assert (GUIDE / picture).is_file(), picture


def test_every_picture_is_shown_and_together_they_are_small():
    shown = {name for page in PAGES.values() for name in re.findall(r"\]\(pictures/([^)]+)\)", page.text)}
    there = {path.name for path in (GUIDE / "pictures").iterdir()}
    assert there == shown
    assert sum(path.stat().st_size for path in (GUIDE / "pictures").iterdir()) < 3_000_000


def test_every_bold_menu_entry_is_an_action(rows):
    entries = {f"{row.menu} → {row.plain_text}" for row in rows}
    named = [(page, text.removesuffix("…")) for page, text in marked() if "→" in text]
    assert len(named) > 40
    assert [one for one in named if one[1] not in entries] == []


def test_dots_stand_where_the_menu_has_them(rows):
    with_dots = {f"{row.menu} → {row.plain_text}": row.text.endswith("…") for row in rows}
    named = [text for _page, text in marked() if "→" in text]
    assert [text for text in named if with_dots[text.removesuffix("…")] != text.endswith("…")] == []


def test_every_other_bold_text_stands_on_the_screen(words_on_screen):
    named = [(page, text) for page, text in marked() if "→" not in text and page != "index.md"]
    of_tables = {"Green", "Amber"}  # what the colour of a box is called
    wrong = [one for one in named if plain(one[1]) not in words_on_screen | of_tables]
    assert len(named) > 60
    assert wrong == []


def test_every_key_is_one(rows):
    known = {key for row in rows for key in row.keys} | OF_WIDGETS
    used = {
        (page.name, text) for page in PAGES.values() for text in re.findall(r"`([^`]+)`", page.text) if _KEY.match(text)
    }
    assert len(used) > 40
    assert sorted(one for one in used if one[1] not in known) == []


def test_a_key_behind_a_menu_entry_is_its_own(rows):
    keys_of = {f"{row.menu} → {row.plain_text}": row.keys for row in rows}
    pairs = [
        (one_line(entry).removesuffix("…"), key)
        for page in PAGES.values()
        for entry, key in _WITH_KEY.findall(page.text)
    ]
    assert len(pairs) > 25
    assert [pair for pair in pairs if pair[1] not in keys_of[pair[0]]] == []


def test_every_part_that_has_a_page_exists_and_so_does_the_page():
    from bobdesk.ui.guide.context import PAGE_OF_PART, PAGE_OF_STEP

    classes = {
        node.name
        for path in (ROOT / "bobdesk" / "ui").rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.ClassDef)
    }
    assert set(PAGE_OF_PART) <= classes
    for link in (*PAGE_OF_PART.values(), *PAGE_OF_STEP.values()):
        name, heading = split_link(link)
        headings = {slug(found) for found in re.findall(r"^#+ +(.+?)\s*$", PAGES[name].text, re.MULTILINE)}
        assert not heading or heading in headings, link


def test_the_words_are_those_of_the_readme():
    def table(text):
        return text[text.index("| use | meaning | not |") :].split("\n\n")[0]

    assert table(PAGES["words.md"].text) == table((ROOT / "README.md").read_text("utf-8"))


def test_the_figures_of_how_good_it_is_are_those_of_the_readme():
    def numbers(text, first):
        table = text[text.index(first) :].split("\n\n")[0]
        return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[1:]]

    readme = numbers((ROOT / "README.md").read_text("utf-8"), "| line | none |")
    assert len(readme) == 5
    assert numbers(PAGES["what-the-data-leave-open.md"].text, "| Line | no elevation") == readme


def columns_below(heading, head="| Column"):
    """The first cells of the first table below a heading or a sentence."""
    text = PAGES["files.md"].text
    text = text[text.index(heading) :]
    table = text[text.index(head) :].split("\n\n")[0]
    return [re.findall(r"`([^`]+)`", line)[0] for line in table.splitlines()[2:]]


@pytest.fixture(scope="module")
def line():
    from bobdesk.files.project_file import load_project
    from bobdesk.project.derive_runs import run_line

    return run_line(load_project(ROOT / "resources" / "samples" / "mugello" / "mugello.bobdesk").run)


def header(content):
    return content.decode("utf-8-sig").splitlines()[0].split(",")


def test_the_columns_of_the_line_are_those_that_are_written(line):
    import json

    from bobdesk.files.exporters.json_line import to_json_line
    from bobdesk.files.exporters.tables import LINE_COLUMNS, line_table

    assert header(line_table(line)) == columns_below("## The 3D line: CSV") == list(LINE_COLUMNS)
    document = json.loads(to_json_line(line))
    assert set(document["columns"]) == set(LINE_COLUMNS) - {"kind"}
    assert list(document["segments"][0]) == columns_below("## The 3D line: BobDesk JSON", "| Key")
    text = one_line(PAGES["files.md"].text)
    assert "`figures` holds " + " and ".join(
        [", ".join(f"`{name}`" for name in list(document["figures"])[:-1]), f"`{list(document['figures'])[-1]}`"]
    ) in text  # fmt: skip


def test_the_columns_of_the_figures_are_those_that_are_written(line):
    from bobdesk.files.exporters.figures_table import to_figures_table

    content = to_figures_table(line)
    assert header(content) == columns_below("## Table of figures")
    figures = list(dict.fromkeys(row.split(",")[0] for row in content.decode().splitlines()[1:]))
    assert figures == columns_below("## Table of figures", "| Figure")


def test_the_columns_of_the_commands_are_those_that_are_written():
    from bobdesk.files.exporters import study_tables, tables
    from bobdesk.files.published_tables import METHODS, published_table
    from bobdesk.files.rules_file import findings_table
    from bobdesk.plan.traced_line import Trace
    from bobdesk.solve.envelope import Envelope

    points = np.array([[0.0, 0.0], [10.0, 0.0]])
    trace = Trace(points, np.ones(2), 2.0, "line", (), np.zeros((0, 2)))
    assert header(tables.trace_table(points, trace)) == columns_below("`bobdesk trace` writes")
    two = np.array([0.0, 1.0])
    assert header(tables.envelope_table(Envelope(two, two, two))) == columns_below("--envelope` writes")
    assert header(study_tables.study_table([])) == columns_below("`bobdesk study` and")
    assert header(findings_table([])) == columns_below("`bobdesk rules` and")
    published = header(published_table([]))
    first = columns_below("`bobdesk published` and")
    assert published[: len(first)] == first
    others = one_line(PAGES["files.md"].text).split("After these come")[1]
    named = re.findall(r"`([^`]+)`", others)
    for name in published[len(first) :]:
        who = next(one for one in ("paper", *METHODS) if name.startswith(f"{one}_"))
        assert name.removeprefix(f"{who}_") in named
    assert header(study_tables.methods_table([])) == columns_below("--second-opinions` and")


def test_the_columns_of_the_segments_are_those_that_are_written():
    from bobdesk.files.exporters.tables import segments_table
    from bobdesk.files.project_file import load_project
    from bobdesk.project import derive

    project = load_project(ROOT / "resources" / "samples" / "mugello" / "mugello.bobdesk")
    first, *others = derive.segments(project).needed()
    content = segments_table(derive.centreline(project).needed(), (replace(first, locked=True), *others))
    assert header(content) == columns_below("## Segments")


def test_the_columns_of_the_error_budget_are_those_that_are_written(line):
    from types import SimpleNamespace

    from bobdesk.files.exporters.study_tables import budget_table, error_band_table

    budget = SimpleNamespace(shares=[], line=line, stations=line.stations,
                             elevation=line.stations, gradient=line.stations)  # fmt: skip
    assert header(budget_table(budget)) == columns_below("--error-budget` writes")
    assert header(error_band_table(budget)) == columns_below("--error-band` writes")


def test_the_columns_of_known_elevations_are_those_that_are_read(tmp_path):
    from bobdesk.files.importers.known_elevations import read_known_elevations

    columns = columns_below("## Known elevations")
    path = tmp_path / "known.csv"
    path.write_text(",".join(columns) + "\n100,20,0.5\n")
    (known,) = read_known_elevations(path)
    assert (known.station, known.elevation, known.tolerance) == (100, 20, 0.5)
    path.write_text(",".join(reversed(columns)) + "\n0.5,20,100\n")
    (known,) = read_known_elevations(path)
    assert (known.station, known.elevation, known.tolerance) == (100, 20, 0.5)


def test_the_folders_are_those_that_are_used(monkeypatch):
    import platformdirs.macos
    import platformdirs.unix

    for name in ("XDG_DATA_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name)
    text = PAGES["questions.md"].text
    home = str(Path("~").expanduser())
    for system in (platformdirs.unix.Unix, platformdirs.macos.MacOS):
        dirs = system("bobdesk", appauthor=False)
        for place in (dirs.user_data_dir, f"{dirs.user_config_dir}/settings.ini"):
            assert f"`{place.replace(home, '~')}`" in text
