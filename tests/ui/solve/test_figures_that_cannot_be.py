"""Figures that no track can have: refused in the unit in which they are typed, or answered with what would help."""

from dataclasses import replace

import pytest
from PySide6.QtCore import QLocale, Qt

from bobdesk.errors import InputError
from bobdesk.project import edits
from bobdesk.project.project import TargetSet


def entered(qtbot, field, text):
    field.setFocus()
    field.selectAll()
    qtbot.keyClicks(field, text)
    qtbot.keyClick(field, Qt.Key.Key_Return)


def offers(panel):
    return {button.text(): button for button in panel.feasibility.box.buttons}


@pytest.mark.parametrize("typed", ["0", "-5"])
def test_a_mean_gradient_that_does_not_go_down_is_refused(desk, panel, qtbot, told, typed, opened):
    entered(qtbot, panel.targets.mean, typed)
    assert told == ["the mean gradient is the drop divided by the length, so it must be more than 0"]
    assert desk.session.project is opened
    assert panel.targets.mean.text() == ""


def test_a_mean_of_segments_may_be_negative_until_it_is_to_be_another_mean(desk, panel, qtbot, told):
    panel.targets.definition.setCurrentIndex(2)
    panel.targets.definition.activated.emit(2)
    entered(qtbot, panel.targets.mean, "-1")
    assert desk.session.project.targets.mean_gradient == pytest.approx(-0.01)
    assert told == []
    panel.targets.definition.setCurrentIndex(1)
    panel.targets.definition.activated.emit(1)
    assert told == ["the mean gradient is the drop divided by the length in plan, so it must be more than 0"]
    assert panel.targets.definition.currentIndex() == 2
    assert desk.session.project.targets.mean_gradient_is == "segments"


def test_a_set_of_targets_with_such_a_mean_gradient_is_refused(opened):
    with pytest.raises(InputError, match="must be more than 0"):
        edits.add_target_set(opened, TargetSet("Juniors", 700.0, 60.0, -0.09))


def test_an_older_file_with_a_negative_mean_gradient_is_told_of_and_offered_the_one_that_follows(
    desk, panel, opened, idle, qtbot
):
    wrong = replace(opened.targets, mean_gradient=-0.09)
    desk.session.open(replace(opened, target_sets=(wrong,)), None)
    idle()
    assert "so it must be more than 0." in panel.feasibility.box.sentence
    (text,) = offers(panel)
    assert text.startswith("Keep the others, mean gradient ")
    qtbot.mouseClick(offers(panel)[text], Qt.MouseButton.LeftButton)
    targets = desk.session.project.targets
    assert targets.mean_gradient == pytest.approx(targets.drop / targets.length, rel=1e-4)
    idle()
    assert panel.feasibility.box.sentence.startswith("✓")
    desk.session.apply("Length", lambda now: edits.set_length(now, None))
    desk.session.open(replace(opened, target_sets=(replace(wrong, length=None),)), None)
    idle()
    assert offers(panel) == {}, "no length follows from a negative mean gradient"


def test_limits_are_refused_in_percent_as_they_are_typed(desk, panel, qtbot, told, opened):
    entered(qtbot, panel.targets.lowest, "30")
    assert told == ["The smallest gradient, 30 %, must be less than the largest, 25 %."]
    assert panel.targets.lowest.text() == "-20"
    entered(qtbot, panel.targets.highest, "-20.5")
    assert told[1:] == ["The smallest gradient, −20 %, must be less than the largest, −20.5 %."]
    entered(qtbot, panel.targets.highest, "250")
    assert told[2:] == ["A gradient must lie between −200 % and 200 %, downhill positive, not at 250 %."]
    entered(qtbot, panel.targets.mean, "-300")
    assert told[3:] == ["A gradient must lie between −200 % and 200 %, downhill positive, not at −300 %."]
    assert desk.session.project is opened
    assert panel.targets.highest.text() == "25"
    entered(qtbot, panel.targets.highest, "30")
    assert desk.session.project.limits.max_gradient == pytest.approx(0.3)


def test_limits_are_refused_in_degrees_where_these_are_typed(desk, panel, qtbot, told, opened):
    QLocale.setDefault(QLocale(QLocale.Language.German, QLocale.Country.Germany))
    desk.settings.gradient_unit = "degrees"
    entered(qtbot, panel.targets.highest, "-30,5")
    entered(qtbot, panel.targets.highest, "170")
    assert told[0].endswith("must be less than the largest, −30,5 °.")
    assert told[1] == "A gradient must lie between −63,4 ° and 63,4 °, downhill positive, not at 170 °."
    assert desk.session.project is opened


@pytest.mark.parametrize("typed", ["-2", "0", "2000"])
def test_a_change_of_gradient_is_refused_as_it_is_typed(desk, panel, qtbot, told, opened, typed):
    entered(qtbot, panel.targets.change, typed)
    assert told == [f"The change in 10 m must be more than 0 % and at most 1,000 %, not {typed} %."]
    assert desk.session.project is opened


def test_length_and_drop_in_each_others_fields_are_swapped_with_one_click(desk, panel, qtbot, idle):
    length, drop = desk.session.project.targets.length, desk.session.project.targets.drop
    desk.session.apply("Other way", lambda now: edits.set_drop(edits.set_length(now, drop), length))
    idle()
    box = panel.feasibility.box
    assert box.sentence.startswith("! The drop must be more than 0 m and less than the length, not ")
    assert box.sentence.endswith(" m.")
    (swap,) = offers(panel)
    assert swap == "Swap length and height difference"
    qtbot.mouseClick(offers(panel)[swap], Qt.MouseButton.LeftButton)
    assert (desk.session.project.targets.length, desk.session.project.targets.drop) == (length, drop)
    idle()
    assert box.sentence.startswith("✓")
    desk.session.undo()
    assert desk.session.project.targets.length == drop
    idle()


def test_a_drop_of_more_than_the_length_is_derived_from_the_mean_gradient(desk, panel, qtbot, idle):
    length = desk.session.project.targets.length
    desk.session.apply("Mean", lambda now: edits.set_mean_gradient(now, 0.08))
    desk.session.apply("Drop", lambda now: edits.set_drop(now, 2 * length))
    idle()
    (keep,) = offers(panel)
    assert keep.startswith("Keep the others, height difference"), "no length is offered that the plan cannot have"
    qtbot.mouseClick(offers(panel)[keep], Qt.MouseButton.LeftButton)
    assert desk.session.project.targets.drop == pytest.approx(0.08 * length, abs=1e-3)
    desk.session.apply("Scale", edits.find_the_scale)
    desk.session.apply("Drop", lambda now: edits.set_drop(now, 2 * length))
    idle()
    assert [text.partition(" ")[0] for text in offers(panel)] == ["Swap", "Keep", "Keep"], "any length, without a scale"
    assert panel.widget().minimumSizeHint().width() <= 430


def test_what_is_missing_is_said_in_a_whole_sentence(desk, panel, idle):
    desk.session.apply("Length", lambda now: edits.set_length(now, None))
    idle()
    assert panel.feasibility.box.sentence == "The length of Track must be given."
