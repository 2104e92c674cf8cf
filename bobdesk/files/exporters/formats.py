"""The table of formats that a 3D centreline is written in, and the one function that writes any of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from bobdesk.errors import InputError
from bobdesk.files.exporters.csv_flavours import FLAVOURS
from bobdesk.files.exporters.dxf import to_dxf
from bobdesk.files.exporters.figures_table import to_figures_table
from bobdesk.files.exporters.geojson import to_geojson
from bobdesk.files.exporters.json_line import to_json_line
from bobdesk.files.exporters.kml import to_kml
from bobdesk.files.exporters.tables import line_table
from bobdesk.files.plugins import Plugins, find_plugins
from bobdesk.plan.projection import Georeference
from bobdesk.track.centreline3d import Centreline3D

EXPORTER_GROUP = "bobdesk.exporters"


@dataclass(frozen=True)
class ExportOptions:
    """What a format may need beside the line.

    Attributes
    ----------
    flavour
        How tables are written; a key of `FLAVOURS`.
    georeference
        Where the plan's origin lies on the Earth, None if that is not known.
    """

    flavour: str = "default"
    georeference: Georeference | None = None


@dataclass(frozen=True)
class ExportFormat:
    """A format that lines are written in; what an entry point of the group "bobdesk.exporters" must be.

    Attributes
    ----------
    key
        Short name in lower case, as `--format` takes it.
    title
        For a person.
    extension
        In lower case, with the dot.
    write
        Returns the file's bytes; raises InputError, and nothing else, with one sentence.
    is_table
        Whether the flavours of CSV apply.
    needs_georeference
        Whether it can be written only where the plan has its place on the Earth.
    """

    key: str
    title: str
    extension: str
    write: Callable[[Centreline3D, ExportOptions], bytes]
    is_table: bool = False
    needs_georeference: bool = False


def _csv(line: Centreline3D, options: ExportOptions) -> bytes:
    return line_table(line, flavour=options.flavour)


def _figures(line: Centreline3D, options: ExportOptions) -> bytes:
    return to_figures_table(line, flavour=options.flavour)


def _json(line: Centreline3D, options: ExportOptions) -> bytes:
    return to_json_line(line, georeference=options.georeference)


def _geojson(line: Centreline3D, options: ExportOptions) -> bytes:
    return to_geojson(line, georeference=_place(options, "GeoJSON"))


def _kml(line: Centreline3D, options: ExportOptions) -> bytes:
    return to_kml(line, georeference=_place(options, "KML"))


def _dxf(line: Centreline3D, options: ExportOptions) -> bytes:
    return to_dxf(line)


def _opendrive(line: Centreline3D, options: ExportOptions) -> bytes:
    from bobdesk.files.exporters.opendrive import to_opendrive  # here, for it needs scipy

    return to_opendrive(line, georeference=options.georeference)


def _place(options: ExportOptions, title: str) -> Georeference:
    if options.georeference is None:
        raise InputError(
            f"{title} needs longitudes and latitudes, but the plan has no place on the Earth;"
            " export csv, json, dxf or xodr instead"
        )
    return options.georeference


FORMATS: tuple[ExportFormat, ...] = (
    ExportFormat("csv", "CSV", ".csv", _csv, is_table=True),
    ExportFormat("json", "BobDesk JSON", ".json", _json),
    ExportFormat("geojson", "GeoJSON", ".geojson", _geojson, needs_georeference=True),
    ExportFormat("kml", "KML", ".kml", _kml, needs_georeference=True),
    ExportFormat("dxf", "DXF, 3D polyline", ".dxf", _dxf),
    ExportFormat("xodr", "OpenDRIVE", ".xodr", _opendrive),
    ExportFormat("figures", "Table of figures", ".figures.csv", _figures, is_table=True),
)


def export_formats() -> Plugins[ExportFormat]:
    """Return the formats of this program and of its plug-ins, and why a plug-in could not be used."""
    return find_plugins(EXPORTER_GROUP, ExportFormat, built_in=FORMATS)


def export_format_of(path: Path) -> ExportFormat:
    """Return the format that a file's name asks for.

    Raises
    ------
    InputError
        If no format has such an ending.
    """
    formats = export_formats().formats
    name = path.name.lower()
    # The longest ending first: ".figures.csv" before ".csv".
    for known in sorted(formats, key=lambda known: -len(known.extension)):
        if name.endswith(known.extension):
            return known
    endings = ", ".join(known.extension for known in formats)
    raise InputError(f"{path}: its ending names no format; there are {endings}")


def export_line(
    line: Centreline3D,
    *,
    format: str = "csv",
    flavour: str = "default",
    georeference: Georeference | None = None,
) -> bytes:
    """Return a 3D centreline as a file's bytes.

    Parameters
    ----------
    line
        The line.
    format
        Key of a format: csv, json, geojson, kml, dxf, xodr, figures, or a plug-in's.
    flavour
        Of tables: default, excel-european, tab or xyz.
    georeference
        Where the plan's origin lies on the Earth; geojson and kml need it, json and xodr keep it.

    Raises
    ------
    InputError
        If there is no such format or flavour, or the line cannot be written in it.
    """
    formats = export_formats().formats
    chosen = next((known for known in formats if known.key == format), None)
    if chosen is None:
        raise InputError(f"there is no format '{format[:40]}'; there are {', '.join(known.key for known in formats)}")
    if flavour not in FLAVOURS:
        raise InputError(f"there is no flavour '{flavour[:40]}'; there are {', '.join(FLAVOURS)}")
    options = ExportOptions(flavour, georeference)
    if chosen in FORMATS:
        return chosen.write(line, options)
    try:
        content = chosen.write(line, options)
    except InputError:
        raise
    except Exception as error:
        raise InputError(
            f"the plug-in for {chosen.title} failed: {type(error).__name__}: {' '.join(str(error).split())[:200]}"
        ) from error
    if not isinstance(content, bytes):
        raise InputError(f"the plug-in for {chosen.title} failed: it returned no bytes")
    return content
