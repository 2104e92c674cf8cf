"""Make the Cortina sample's plan from its design figures; the transitions are assumed.

usage: python packaging/make_cortina_sample.py
"""

import json
from pathlib import Path

import numpy as np

SAMPLE = Path(__file__).parent.parent / "resources" / "samples" / "cortina_2026_design"
ASSUMED_TRANSITION = 0.25
STEP = 0.1


def main() -> None:
    design = json.loads((SAMPLE / "design.json").read_text(encoding="utf-8"))
    sections = design["gradient_sections"]
    start = sections[0]["from_m"]
    end = sections[-1]["from_m"] + sections[-1]["length_m"]
    middles = np.arange(start, end, STEP) + STEP / 2

    curvature = np.zeros_like(middles)
    for curve in design["curves"]:
        share = (middles - curve["from_m"]) / curve["length_m"]
        ramp = np.clip(np.minimum(share, 1 - share) / ASSUMED_TRANSITION, 0, 1)
        curvature += (1 if curve["direction"] == "left" else -1) * ramp / curve["radius_m"]
    heading = np.cumsum(curvature * STEP) - curvature * STEP / 2
    first = np.array([section["from_m"] for section in sections])
    gradient = np.array([section["gradient"] for section in sections])[np.searchsorted(first, middles, "right") - 1]

    steps = np.column_stack([np.cos(heading), np.sin(heading), -gradient]) * STEP
    points = np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
    points[:, 2] -= points[:, 2].min()
    every = round(1 / STEP)
    rows = [f"{i * STEP:.3f},{x:.4f},{y:.4f},{z:.4f}" for i, (x, y, z) in enumerate(points)][::every]
    (SAMPLE / "plan.csv").write_text("station_m,x_m,y_m,z_m\n" + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
