"""The bill of materials (SBOM) in CycloneDX's JSON, of what the program needs at run time."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import identity
import runtime
from part import Part


def write(path: Path, others: Iterable[Part]) -> None:
    """Write the bill.

    Parameters
    ----------
    path
        Of the file.
    others
        Parts that are no packages of PyPI.
    """
    told = _told_by_cyclonedx()
    wanted = set(runtime.runtime_distributions())
    kept = [part for part in told["components"] if runtime.normalised(part["name"]) in wanted]
    missing = wanted - {runtime.normalised(part["name"]) for part in kept}
    if missing:
        raise SystemExit(f"cyclonedx-py did not tell of {', '.join(sorted(missing))}")
    for part in kept:
        # Where a package was installed from is this machine's business.
        for key in ("externalReferences", "properties"):
            part.pop(key, None)
    references = {part["bom-ref"] for part in kept}
    own = told["metadata"]["component"]
    own["version"] = identity.VERSION
    for other in others:
        reference = f"carried:{other.name}"
        part = {"type": "library", "bom-ref": reference, "name": other.name, "version": other.version}
        kept.append(part | {"licenses": [{"license": {"name": other.licence}}]})
        references.add(reference)
    told["components"] = sorted(kept, key=lambda part: part["bom-ref"])
    told["dependencies"] = [
        {
            "ref": entry["ref"],
            "dependsOn": sorted(set(entry.get("dependsOn", [])) & references)
            if entry["ref"] != own["bom-ref"]
            else sorted(references),
        }
        for entry in told["dependencies"]
        if entry["ref"] in references | {own["bom-ref"]}
    ]
    path.write_text(json.dumps(told, indent=2, ensure_ascii=False, sort_keys=True) + "\n", encoding="utf-8")


def _told_by_cyclonedx() -> dict[str, Any]:
    # Not validated here, which takes ten times as long as all else: the tests validate what `write` makes of it.
    call = [
        sys.executable,
        "-m",
        "cyclonedx_py",
        "environment",
        "--no-validate",
        "--output-reproducible",
        "--sv",
        "1.6",
    ]
    call += ["--pyproject", str(identity.ROOT / "pyproject.toml"), sys.executable]
    environment = os.environ | {"SOURCE_DATE_EPOCH": str(identity.source_date_epoch())}
    done = subprocess.run(call, check=True, capture_output=True, text=True, encoding="utf-8", env=environment)
    told: dict[str, Any] = json.loads(done.stdout)
    return told
