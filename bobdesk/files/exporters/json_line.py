"""BobDesk's own JSON: all columns of LINE.csv, the segments, and the place on the Earth."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from bobdesk.arrays import FloatArray
from bobdesk.files.importers.json_lines import LINE_FORMAT, LINE_VERSION
from bobdesk.plan.projection import Georeference
from bobdesk.track.centreline3d import Centreline3D
from bobdesk.track.figures import figures

_METRES, _RATIOS = 6, 9  # decimals, as in LINE.csv


def to_json_line(line: Centreline3D, *, georeference: Georeference | None = None) -> bytes:
    """Return a line as JSON; numbers are rounded as those of LINE.csv are."""
    found = figures(line)
    document: dict[str, Any] = {
        "format": LINE_FORMAT,
        "version": LINE_VERSION,
        "georeference": None
        if georeference is None
        else {"longitude": georeference.longitude, "latitude": georeference.latitude},
        "figures": {
            "length_m": round(found.length, _METRES),
            "drop_m": round(found.drop, _METRES),
            "plan_length_m": round(found.plan_length, _METRES),
            "mean_gradient_drop_per_length": round(found.mean_gradient_drop_per_length, _RATIOS),
        },
        "segments": [
            {
                "kind": segment.kind,
                "name": segment.name,
                "from_m": round(segment.start, _METRES),
                "to_m": round(segment.end, _METRES),
                "gradient": round(gradient, _RATIOS),
            }
            for segment, gradient in zip(line.segments, line.segment_gradients.tolist(), strict=True)
        ],
        "columns": {
            "station_m": _rounded(line.stations, _METRES),
            "s_m": _rounded(line.slope_lengths, _METRES),
            "x_m": _rounded(line.points[:, 0], _METRES),
            "y_m": _rounded(line.points[:, 1], _METRES),
            "z_m": _rounded(line.points[:, 2], _METRES),
            "heading_rad": _rounded(line.headings, _RATIOS),
            "gradient": _rounded(line.gradients, _RATIOS),
            "curvature_plan_per_m": _rounded(line.plan_curvature, _RATIOS),
            "curvature_per_m": _rounded(line.curvature, _RATIOS),
            "segment": (line.segment_of + 1).tolist(),
        },
    }
    return (json.dumps(document, allow_nan=False, ensure_ascii=False) + "\n").encode()


def _rounded(values: FloatArray, decimals: int) -> list[float]:
    # Adding 0 turns -0.0 into 0.0.
    result: list[float] = (np.round(values, decimals) + 0.0).tolist()
    return result
