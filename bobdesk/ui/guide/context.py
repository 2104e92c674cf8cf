"""Which page of the guide explains the part of the window that has the keyboard."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from bobdesk.project.steps import StepName

PAGE_OF_STEP: dict[StepName, str] = {
    "Plan": "plan.md",
    "Scale": "scale.md",
    "Centreline": "centreline.md",
    "Segments": "segments.md",
    "Solve": "solve.md",
    "Export": "export.md",
}
# By the name of the widget's class: what is imported only when it is shown need not be imported here.
PAGE_OF_PART: dict[str, str] = {
    "StartPage": "index.md",
    "ImportDialog": "plan.md#from-coordinates",
    "PreferencesDialog": "questions.md#can-i-change-keys-units-colours",
    "PresetDialog": "solve.md#what-is-known-of-the-track",
    "ControlPointsPart": "scale.md#control-points",
    "DistancesPart": "scale.md#known-distances",
    "ScaleFitPart": "scale.md#how-good-is-the-scale",
    "LineOriginPart": "centreline.md#four-ways-to-the-line",
    "VerticesPart": "centreline.md#correct-the-line",
    "DigitisedPart": "centreline.md#which-line-was-drawn",
    "ExtentPart": "centreline.md#start-and-finish",
    "SmoothingPart": "centreline.md#smoothing",
    "AutomaticPart": "segments.md#how-segments-are-found",
    "RulesPart": "segments.md#how-segments-are-found",
    "DesignPart": "segments.md#compare-with-a-design",
    "StripStack": "segments.md#strips-by-station",
    "TargetsPart": "solve.md#what-is-known-of-the-track",
    "FeasibilityBox": "solve.md#can-these-figures-be-met",
    "KnownPart": "solve.md#known-elevations",
    "AdvicePart": "what-the-data-leave-open.md#where-to-measure-next",
    "BudgetPart": "what-the-data-leave-open.md#the-error-budget",
    "DesignRulesPart": "export.md#design-rules",
    "MethodPart": "solve.md#method",
    "RunPart": "solve.md#run",
    "ConvergencePart": "solve.md#run",
    "RunsPart": "solve.md#several-runs",
    "FiguresPart": "solve.md#the-result",
    "ActualPart": "solve.md#beside-the-actual-track",
    "MethodsWindow": "compare.md#compare-methods",
    "StudyWindow": "compare.md#study",
    "PublishedWindow": "compare.md#published-tables",
    "SpaceView": "solve.md#the-result-in-space",
}


def place_in_guide(focus: QWidget | None, step: StepName | None) -> str:
    """Return page and heading for the widget with the keyboard, or else for a step; None for the start page."""
    widget = focus
    while widget is not None:
        place = PAGE_OF_PART.get(type(widget).__name__)
        if place:
            return place
        widget = widget.parentWidget()
    return "index.md" if step is None else PAGE_OF_STEP[step]
