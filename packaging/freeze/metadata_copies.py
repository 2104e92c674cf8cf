"""What is known of the packages in the frozen program: names, versions, licences; for the About window."""

from __future__ import annotations

from importlib import metadata
from pathlib import Path

import runtime

# What pip notes of one installation, which is another one's business.
_OF_THE_INSTALLATION = ("INSTALLER", "RECORD", "REQUESTED", "direct_url.json")


def copy_metadata(folder: Path) -> None:
    """Write a .dist-info folder of each distribution that travels into `folder`.

    RECORD lists what is in these folders and no more: it would tell of scripts with the path of the environment.
    """
    for name in runtime.runtime_distributions():
        listed = []
        for file in metadata.files(name) or ():
            if file.parts[0].endswith(".dist-info") and file.name not in _OF_THE_INSTALLATION:
                target = folder / file
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(file.locate().read_bytes())
                listed.append(file.as_posix())
        record = folder / listed[0].split("/")[0] / "RECORD"
        record.write_text("".join(f"{path},,\n" for path in sorted(listed)), encoding="utf-8", newline="\n")
