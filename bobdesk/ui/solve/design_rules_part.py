"""Design rules beside what the shown result makes of them; a click on one shows where it is broken."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMenu

from bobdesk.errors import InputError
from bobdesk.files.atomic import write_atomic
from bobdesk.project.project import Project
from bobdesk.track.design_rules import QUANTITIES, Finding, Quantity, Rule, judged
from bobdesk.ui.derived import DerivedLater
from bobdesk.ui.questions import Questions
from bobdesk.ui.segments.alignment_now import alignment_now
from bobdesk.ui.solve.rule_words import RuleWords
from bobdesk.ui.solve.sled_fields import SledFields
from bobdesk.ui.solve.usual_rules import rules_of, usual_rules
from bobdesk.ui.widgets.columns_model import Column, ColumnsModel
from bobdesk.ui.widgets.fold import Fold
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.table import Table


class DesignRulesPart(Part):
    """One row a rule: limits, unit, what was found, and the source; everything can be changed and undone."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Design rules"))
        self._now = alignment_now(self.desk)
        self._words = RuleWords(self.desk.quantities, self)
        self._questions = Questions(self.desk.settings, self)
        self.later = DerivedLater(self.desk, self.tr("Judging by the design rules"), _judged, _inputs, self)
        self.summary = panel.add_label("", "", self.column)
        self.model = ColumnsModel(
            self._columns(), lambda: len(self._rules), panel.refuse, stands_out=self._why_it_stands_out,
            is_faint=lambda row: not self._rules[row].is_used, parent=self,
        )  # fmt: skip
        self.table = Table(self.tr("Design rules"), self.model, fewest_rows=4, most_rows=12, parent=self)
        self.table.setSelectionMode(Table.SelectionMode.SingleSelection)
        self.table.fit_columns(
            # What is broken is bold, and wider than the metrics say.
            ("", "acceleration in curves", "! 88,888.8", "8,888", "8,888", "curves", "8,888", "8,888", "x" * 60)
        )
        self.column.addWidget(self.table)
        self.detail = panel.add_label("", "muted", self.column)
        flow = panel.add_buttons(self.column)
        self.add_button = panel.button(flow, self.tr("Add"), self.tr("Add a rule about a quantity"), "plus")
        menu = QMenu(self.add_button)
        for quantity in QUANTITIES:
            menu.addAction(self._words.quantity(quantity), partial(self._on_add, quantity))
        self.add_button.setMenu(menu)
        self.remove_button = panel.button(
            flow, self.tr("Remove"), self.tr("Take the selected rule away (Del)"), "minus"
        )
        self.load_button = panel.button(flow, self.tr("Load…"), self.tr("Take rules from a JSON file"), "load")
        self.save_button = panel.button(
            flow,
            self.tr("Save rules…"),
            self.tr("Write the rules as JSON, for other projects and the command"),
            "save-as",
        )
        self.findings_button = panel.button(
            flow, self.tr("Save findings…"), self.tr("Write the findings with their stretches as CSV"), "export"
        )
        self.reset_button = panel.button(
            flow, self.tr("Usual rules"), self.tr("Go back to the rules that come with BobDesk"), "reset"
        )
        self.sled_fold = Fold(self.tr("The sled that speeds and loads are judged by"), self)
        self.column.addWidget(self.sled_fold)
        self.sled = SledFields(panel, self.sled_fold.column)
        self.remove_button.clicked.connect(self._on_remove)
        self.table.on_key(Qt.Key.Key_Delete, self.remove_button)
        self.load_button.clicked.connect(self._on_load)
        self.save_button.clicked.connect(self._on_save)
        self.findings_button.clicked.connect(self._on_save_findings)
        self.reset_button.clicked.connect(self._on_reset)
        self.table.selectionModel().selectionChanged.connect(self._on_row)
        self.table.clicked.connect(self._on_clicked)
        self.later.changed.connect(lambda: self.refresh(self.desk.session.project))
        self.desk.quantities.changed.connect(self._on_units)

    @property
    def _rules(self) -> tuple[Rule, ...]:
        return rules_of(self.desk.session.project)

    def finding(self, row: int) -> Finding | None:
        """Return what the shown result makes of a rule; None while it is not known, or the rule not used."""
        found: tuple[Finding, ...] | None = self.later.value
        if found is None or not self.later.is_current or not 0 <= row < len(self._rules):
            return None
        rule = self._rules[row]
        return next((one for one in found if one.rule is rule), None)

    def refresh(self, project: Project) -> None:
        """Show the rules of a project."""
        self.model.refresh()
        self.sled.refresh(project)
        self.reset_button.setEnabled(project.rules is not None)
        self.save_button.setEnabled(bool(self._rules))
        self.findings_button.setEnabled(bool(self.later.value) and self.later.is_current)
        self.summary.setText(self._summary(project))
        self._on_row()

    def take(self, path: Path) -> None:
        """Take rules from a file in the place of all."""
        from bobdesk.files.rules_file import read_rules
        from bobdesk.project import edits

        try:
            rules = read_rules(path)
        except InputError as error:
            self.desk.notices.error(str(error))
            return
        self.desk.session.apply(self.tr("Load design rules"), lambda project: edits.set_rules(project, rules))

    def write(self, path: Path, content: bytes) -> None:
        """Write a file and say so."""
        try:
            write_atomic(path, content)
        except InputError as error:
            self.desk.notices.error(str(error))
            return
        self.desk.notices.note(self.tr("Written to {name}.").format(name=path.name))

    def _summary(self, project: Project) -> str:
        if not self._rules:
            return self.tr(
                "There are no rules in the list. Usual rules brings back those that come with BobDesk,"
                " Add and Load… put in others."
            )
        if not any(rule.is_used for rule in self._rules):
            return self.tr("No rule in the list is ticked: nothing is judged.")
        if project.run is None:
            return self.tr("There is no result yet to judge: solve first.")
        found: tuple[Finding, ...] | None = self.later.value
        if found is None or not self.later.is_current:
            return self.later.problem or self.tr("Judging …")
        count = {verdict: sum(one.verdict == verdict for one in found) for verdict in ("kept", "broken", "not judged")}
        text = self.tr(
            "{kept} kept, {broken} broken, {open} not judged. All rules that come with BobDesk are second hand."
        )
        return text.format(kept=count["kept"], broken=count["broken"], open=count["not judged"])

    def _columns(self) -> tuple[Column, ...]:
        words = self._words

        def limit(heading: str, tip: str, field: str) -> Column:
            return Column(
                lambda: heading,
                tip,
                lambda row: words.limit(self._rules[row], getattr(self._rules[row], field)),
                lambda row: words.to_edit(self._rules[row], getattr(self._rules[row], field)),
                lambda row, text: self._change(row, **{field: words.typed(self._rules[row], text)}),
            )

        def place(heading: str, tip: str, field: str) -> Column:
            return Column(
                lambda: f"{heading} {self.desk.quantities.length_unit}",
                tip,
                lambda row: words.station(getattr(self._rules[row], field)),
                lambda row: words.station_to_edit(getattr(self._rules[row], field)),
                lambda row, text: self._change(row, **{field: words.typed_station(text, field)}),
            )

        return (
            Column(
                str,
                self.tr("Whether the rule is used"),
                lambda _row: "",
                is_checked=lambda row: self._rules[row].is_used,
                check=lambda row, on: self._change(row, is_used=on),
                is_number=False,
            ),
            Column(
                lambda: self.tr("Rule"),
                self.tr("What is asked for"),
                lambda row: self._rules[row].name,
                lambda row: self._rules[row].name,
                lambda row, text: self._change(row, name=text.strip()),
                is_number=False,
            ),
            Column(
                lambda: self.tr("Found"),
                self.tr("✓ kept, ! broken, – not judged; click to see where"),
                self._found,
                marks=True,
            ),
            limit(self.tr("Min."), self.tr("Smallest value; empty for none"), "lowest"),
            limit(self.tr("Max."), self.tr("Largest value; empty for none"), "highest"),
            Column(
                lambda: self.tr("Unit"),
                self.tr("Unit of the limits"),
                lambda row: words.unit(self._rules[row]),
            ),
            place(self.tr("From"), self.tr("Where the stretch begins"), "start"),
            place(self.tr("To"), self.tr("Where it ends; empty is the lowest point, or the finish"), "end"),
            Column(
                lambda: self.tr("Source"),
                self.tr("Where the rule comes from"),
                lambda row: self._rules[row].source,
                lambda row: self._rules[row].source,
                lambda row, text: self._change(row, source=text.strip()),
                is_number=False,
            ),
        )

    def _found(self, row: int) -> str:
        found = self.finding(row)
        if found is None:
            return ""
        if found.value is None:
            return "–"
        return ("✓ " if found.verdict == "kept" else "! ") + self._words.value(found.rule, found.value)

    def _why_it_stands_out(self, row: int) -> str:
        found = self.finding(row)
        return "" if found is None or found.verdict != "broken" else self._words.sentence(found)

    def _change(self, row: int, **values: Any) -> bool:
        from bobdesk.project import edits

        rule = replace(self._rules[row], **values)
        return self.desk.session.apply(
            self.tr("Change design rule"),
            lambda project: edits.change_rule(project, row, rule, usual=usual_rules()),
        )

    def _on_add(self, quantity: Quantity) -> None:
        from bobdesk.project import edits

        rule = Rule(self._words.quantity(quantity), quantity, source=self.tr("own"))
        if self.desk.session.apply(
            self.tr("Add design rule"), lambda project: edits.add_rule(project, rule, usual=usual_rules())
        ):
            place = self.model.index(len(self._rules) - 1, 4)
            self.table.setCurrentIndex(place)
            self.table.edit(place)

    def _on_remove(self) -> None:
        from bobdesk.project import edits

        row = self._row()
        if row is not None:
            self.desk.session.apply(
                self.tr("Remove design rule"), lambda project: edits.remove_rule(project, row, usual=usual_rules())
            )

    def _on_reset(self) -> None:
        from bobdesk.project import edits

        self.desk.session.apply(self.tr("Usual design rules"), lambda project: edits.set_rules(project, None))

    def _on_load(self) -> None:
        path = self._questions.file_to_open("rules", self.tr("Design rules"), "JSON (*.json)")
        if path is not None:
            self.take(path)

    def _on_save(self) -> None:
        from bobdesk.files.rules_file import rules_json

        self._ask(self.tr("design-rules.json"), ".json", lambda: rules_json(self._rules))

    def _on_save_findings(self) -> None:
        from bobdesk.files.rules_file import findings_table

        self._ask(self.tr("findings.csv"), ".csv", lambda: findings_table(self.later.value or ()))

    def _ask(self, name: str, ending: str, content: Callable[[], bytes]) -> None:
        kind = f"{ending[1:].upper()} (*{ending})"
        path = self._questions.file_to_save("rules", self.tr("Design rules"), name, kind, ending)
        if path is not None:
            self.write(path, content())

    def _row(self) -> int | None:
        rows = self.table.selectionModel().selectedRows()
        return rows[0].row() if rows else None

    def _on_row(self) -> None:
        row = self._row()
        self.remove_button.setEnabled(row is not None)
        self.detail.setVisible(bool(self._rules))
        found = None if row is None else self.finding(row)
        if found is not None:
            self.detail.setText(self._words.sentence(found))
        elif row is not None and row < len(self._rules):
            self.detail.setText(self._words.said_of(self._rules[row]))
        else:
            self.detail.setText(self.tr("Click a rule to see where it is broken; click again for the next stretch."))

    def _on_clicked(self) -> None:
        row = self._row()
        found = None if row is None else self.finding(row)
        value = self._now.value
        if found is None or not found.stretches or value is None:
            self.desk.selection.stretch = None
            return
        run = self.desk.session.project.run
        own = value.line.length if run is None else run.figures.plan_length
        places = [tuple(each * value.line.length / own for each in stretch) for stretch in found.stretches]
        shown = self.desk.selection.stretch
        # Another click on the same rule goes on to its next stretch.
        at = next((index for index, place in enumerate(places) if shown is not None and _near(place, shown)), -1)
        start, end = places[(at + 1) % len(places)]
        self.desk.selection.stretch = (start, end)

    def _on_units(self) -> None:
        self.model.refresh_headings()
        self.refresh(self.desk.session.project)


def _near(one: tuple[float, ...], other: tuple[float, float]) -> bool:
    return max(abs(a - b) for a, b in zip(one, other, strict=True)) < 1.5


def _inputs(project: Project) -> tuple[object, ...] | None:
    return None if project.run is None else (project.run.layout, rules_of(project), project.sled)


def _judged(project: Project) -> tuple[Finding, ...]:
    from bobdesk.project.derive_runs import run_line

    assert project.run is not None
    return judged(run_line(project.run), rules_of(project), project.sled)
