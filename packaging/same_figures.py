"""Compare what `bobdesk selftest --report` found on several systems: python packaging/same_figures.py REPORT REPORT …

Every report must have passed, be of the same version, and have the same lengths, elevations and mean gradients to six
digits. What is said of a single place of the line (its steepest edge) and differences of nearly equal numbers (percent
off the truth) follow the solver's last iterate, and differ by up to 1e-5 between processors whose libraries round
differently: of these four digits are compared. How many iterations it took may differ.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

PARTS = ("figures", "against_the_truth", "counts")
TO_SIX_DIGITS = (
    "length",
    "drop",
    "plan_length",
    "mean_gradient_drop_per_length",
    "mean_gradient_drop_per_plan",
    "metres_per_pixel",
    "z_rms",
)
MAY_DIFFER = ("iterations",)


def differences(first: dict[str, Any], other: dict[str, Any]) -> list[str]:
    """Return the figures in which two reports differ, a sentence each."""
    found = []
    if first["version"] != other["version"]:
        found.append(f"version {other['version']}, not {first['version']}")
    for part in PARTS:
        for name in sorted({*first[part], *other[part]} - {*MAY_DIFFER}):
            one, two = first[part].get(name), other[part].get(name)
            if one is None or two is None or not _same(name, one, two):
                found.append(f"{name} {two!r}, not {one!r}")
    return found


def _same(name: str, one: float, two: float) -> bool:
    if name in TO_SIX_DIGITS:
        return math.isclose(one, two, rel_tol=1e-6)
    return math.isclose(one, two, rel_tol=1e-4, abs_tol=1e-5)


def main(arguments: list[str]) -> int:
    if len(arguments) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    reports = {path: json.loads(Path(path).read_text(encoding="utf-8")) for path in arguments}
    wrong = [f"{path}: {report['step']}: {report['error']}" for path, report in reports.items() if not report["passed"]]
    if not wrong:
        first, *others = reports
        for other in others:
            wrong += [f"{other}: {sentence}" for sentence in differences(reports[first], reports[other])]
    for path, report in reports.items():
        system, figures = report["system"], report.get("figures", {})
        print(f"{system['platform']}, {system['machine']}: {figures.get('length')} m ({path})")
    print("\n".join(wrong) or "the same figures")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8")  # type: ignore[union-attr]
    sys.exit(main(sys.argv[1:]))
