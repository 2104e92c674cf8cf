"""Plans, targets and finished runs for the tests of the solvers."""

from dataclasses import dataclass

import numpy as np

from bobdesk.alignment.centreline import Centreline
from bobdesk.alignment.segmentation import detect_segments
from bobdesk.alignment.segments import Segments
from bobdesk.progress import finish
from bobdesk.solve.iterates import Solution
from bobdesk.solve.pgd import pgd
from bobdesk.solve.targets import KnownElevation, Targets
from bobdesk.track.centreline3d import Centreline3D, make_centreline3d
from tests.alignment.made_lines import DATA, fitted, made_plan

REAL_LINES = {
    "mugello": "mugello_3d_descent_700m.csv",
    "franciacorta": "franciacorta_karting_3d_descent_250m.csv",
    "sa_calobra": "sa_calobra_descent_first_1490m.csv",
}


@dataclass(frozen=True)
class Run:
    """A finished run and the line that is exported from it."""

    solution: Solution
    line: Centreline3D
    iterates: tuple


def run_pgd(centreline, segments, targets, settings=None) -> Run:
    iterates = []
    solution = finish(pgd(centreline, segments, targets, settings), iterates.append)
    return Run(solution, make_centreline3d(centreline, segments, solution), tuple(iterates))


def plan_of(points, *, spacing=1.0) -> tuple[Centreline, Segments]:
    centreline = fitted(points, spacing=spacing)
    return centreline, detect_segments(centreline)


def made(seed, *, curves=8) -> tuple[Centreline, Segments]:
    return plan_of(made_plan(seed, curves=curves))


def straight_plan(length, *, spacing=1.0) -> Centreline:
    along = np.linspace(0.0, length, round(length / spacing) + 1)
    return fitted(np.column_stack([along, np.zeros_like(along)]), spacing=spacing, wavelength=0.0)


def length_of(line) -> float:
    return float(np.linalg.norm(np.diff(line.points, axis=0), axis=1).sum())


def height_at(line, stations):
    return np.interp(stations, line.stations, line.elevations)


@dataclass(frozen=True)
class RealLine:
    """A surveyed line; elevations from its lowest point."""

    stations: np.ndarray
    plan: np.ndarray
    elevations: np.ndarray

    @property
    def length(self) -> float:
        rows = np.column_stack([self.plan, self.elevations])
        return float(np.linalg.norm(np.diff(rows, axis=0), axis=1).sum())

    @property
    def drop(self) -> float:
        return float(self.elevations[0])

    def targets(self, *, known=0, plan_scale=1.0, **others) -> Targets:
        """Return true length and drop with evenly spaced known elevations, stations as in a plan times plan_scale."""
        at = np.linspace(0.0, self.stations[-1], known + 2)[1:-1]
        heights = np.interp(at, self.stations, self.elevations)
        items = tuple(KnownElevation(float(plan_scale * s), float(z)) for s, z in zip(at, heights, strict=True))
        return Targets(self.length, self.drop, known=items, **others)

    def rms_percent(self, line) -> float:
        share = np.linspace(0.0, 1.0, 1001)
        found = np.interp(share * line.stations[-1], line.stations, line.elevations)
        true = np.interp(share * self.stations[-1], self.stations, self.elevations)
        return float(100 * np.sqrt(np.mean((found - true) ** 2)) / self.drop)


def real_line(name) -> RealLine:
    rows = np.loadtxt(DATA / "lines" / REAL_LINES[name], delimiter=",", skiprows=1)
    stations = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(rows[:, 1:3], axis=0).T))])
    return RealLine(stations, rows[:, 1:3], rows[:, 3] - rows[:, 3].min())
