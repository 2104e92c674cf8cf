"""How a plan comes into the document: pictures and coordinates, opened, dropped, pasted."""

from __future__ import annotations

import io
from collections.abc import Callable, Generator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QMimeData, QObject
from PySide6.QtGui import QImage

from bobdesk.errors import InputError
from bobdesk.files.picture_process import decode_in_process
from bobdesk.files.pictures import picture_bytes, read_picture_steps
from bobdesk.files.project_file import is_project
from bobdesk.plan.image import PlanImage
from bobdesk.plan.picture_format import picture_format
from bobdesk.progress import Progress
from bobdesk.project import edits
from bobdesk.project.project import ActualTrack, Picture, Project, SourceLine
from bobdesk.ui.desk import Desk
from bobdesk.ui.documents import Documents
from bobdesk.ui.plan_picture import DecodedPicture, with_levels_steps
from bobdesk.ui.questions import PICTURE_SUFFIXES, Questions
from bobdesk.ui.session import Edit

if TYPE_CHECKING:
    from bobdesk.files.importers.imported_line import ImportedLine

Looked = tuple["ImportedLine", bool]
LookAtCoordinates = Callable[[Path, bool], "Looked | None"]
_HEAD = 65_536


@dataclass(frozen=True, eq=False)
class _Read:
    picture: Picture
    decoded: DecodedPicture


class Plans(QObject):
    """Brings plans into the document.

    Parameters
    ----------
    look
        Shows the import dialog for a file of coordinates and returns the line and whether its elevations are
        to be kept as the actual track, or None when the user does not want it. Its second argument: whether
        the file is wanted as the actual track.
    """

    def __init__(
        self, desk: Desk, documents: Documents, questions: Questions, look: LookAtCoordinates, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._desk = desk
        self._documents = documents
        self._questions = questions
        self._look = look

    def new_from_picture(self) -> None:
        """Ask for a picture and begin a project with it."""
        path = self._questions.file_to_open("pictures", self.tr("New from picture"), self._questions.picture_filter())
        if path is not None:
            self.open_picture(path)

    def new_from_coordinates(self) -> None:
        """Ask for a file of coordinates and begin a project with it."""
        path = self._questions.file_to_open("coordinates", self.tr("New from coordinates"), self._coordinate_filter())
        if path is not None:
            self.open_coordinates(path)

    def compare_with_file(self) -> None:
        """Ask for the actual track, a file of coordinates with elevations."""
        path = self._questions.file_to_open("coordinates", self.tr("Compare with a file"), self._coordinate_filter())
        if path is None:
            return
        looked = self._look(path, True)
        if looked is None:
            return
        actual = _actual(looked[0], path.name)
        if actual is None:
            self._desk.notices.error(
                self.tr("{name} has no elevations, so there is nothing to compare with.").format(name=path.name)
            )
            return
        self._desk.session.apply(
            self.tr("Compare with {name}").format(name=path.name), lambda project: edits.compare_with(project, actual)
        )

    def open_any(self, path: Path) -> None:
        """Open a file of any kind that BobDesk knows."""
        if is_project(path):
            self._documents.open_project(path)
            return
        try:
            is_picture = self._is_picture(path)
        except (InputError, OSError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
            self._desk.notices.error(self.tr("{name} cannot be opened: {reason}").format(name=path.name, reason=reason))
            return
        if is_picture:
            self.open_picture(path)
        else:
            self.open_coordinates(path)

    def open_picture(self, path: Path, *, name: str = "") -> None:
        """Read a picture in the background and make it the plan, under another name than its file's if one is given."""
        shown = name or path.name

        def job() -> Generator[Progress, None, _Read]:
            data = picture_bytes(path)
            image = yield from read_picture_steps(path)
            return (yield from _prepared(image, data, shown))

        self._read(job, shown)

    def paste(self, mime: QMimeData) -> None:
        """Take what the clipboard holds: files, or a picture."""
        paths = local_paths(mime)
        if paths:
            self.open_any(paths[0])
            return
        data = _picture_in(mime)
        if data is None:
            self._desk.notices.note(
                self.tr("The clipboard holds no picture and no file; copy a picture of the plan and paste it here.")
            )
            return
        name = self.tr("pasted picture") + ".png"

        def job() -> Generator[Progress, None, _Read]:
            decoded = yield from decode_in_process(data, name=name, world=None)
            return (yield from _prepared(decoded, data, name))

        self._read(job, name)

    def open_coordinates(self, path: Path) -> None:
        """Show what a file of coordinates holds, and make it the plan if the user wants it."""
        looked = self._look(path, False)
        if looked is None:
            return
        line, keep_elevations = looked
        origin = line.georeference
        source = SourceLine(
            path.name,
            line.polyline,
            None if origin is None else origin.longitude,
            None if origin is None else origin.latitude,
        )
        actual = _actual(line, path.name) if keep_elevations else None

        def edit(project: Project) -> Project:
            opened = edits.open_coordinates(project, source, line.segments)
            return opened if actual is None else edits.compare_with(opened, actual)

        self._place(self.tr("Open {name}").format(name=path.name), edit, path.name)

    def _read(self, job: Callable[[], Generator[Progress, None, _Read]], name: str) -> None:
        document = self._desk.session.document

        def done(found: _Read) -> None:
            self._desk.picture.keep(found.picture, found.decoded)
            self._place(
                self.tr("Open {name}").format(name=name),
                lambda project: edits.open_picture(project, found.picture),
                name,
                is_meant=self._desk.session.document is document,
            )
            for note in found.decoded.image.notes:
                self._desk.notices.note(note)

        self._desk.runner.start(
            self.tr("Reading {name}").format(name=name), job, done=done, failed=self._desk.notices.error
        )

    def _place(self, label: str, edit: Edit, name: str, *, is_meant: bool = True) -> None:
        """Make it the plan of a new project, or of the open one if the user says so or that has none yet.

        `is_meant` is False where another document was opened after the plan had been asked for: that is asked about.
        """
        session = self._desk.session

        def begin() -> None:
            self._documents.begin()
            session.apply(label, lambda project: edits.name_project(edit(project), Path(name).stem))

        if not session.is_open:
            begin()
        elif is_meant and session.project.picture is None and session.project.source is None:
            session.apply(label, edit)
        else:
            answer = self._questions.where_to_put_plan(name, is_meant=is_meant)
            if answer == "new":
                self._documents.guard(begin)
            elif answer == "replace":
                session.apply(label, edit)

    def _is_picture(self, path: Path) -> bool:
        """Return whether a file holds a picture; SVG drawings count as pictures, their lines can be imported, too."""
        with path.open("rb") as stream:
            head = stream.read(_HEAD)
        try:
            picture_format(head, name=path.name)
        except InputError:
            # A damaged picture is told of as one, not as a strange table.
            return path.suffix.lower() in PICTURE_SUFFIXES
        return True

    def _coordinate_filter(self) -> str:
        from bobdesk.files.importers.formats import import_formats

        formats = import_formats().formats
        patterns = " ".join(f"*{suffix}" for known in formats for suffix in known.extensions)
        each = [f"{known.title} ({' '.join(f'*{suffix}' for suffix in known.extensions)})" for known in formats]
        return ";;".join([self.tr("Coordinates") + f" ({patterns})", *each, self.tr("All files") + " (*)"])


def local_paths(mime: QMimeData) -> list[Path]:
    """Return the files of this computer in what was dropped or pasted."""
    return [Path(url.toLocalFile()) for url in mime.urls() if url.isLocalFile()]


def _prepared(image: PlanImage, data: bytes, name: str) -> Generator[Progress, None, _Read]:
    decoded = yield from with_levels_steps(image)
    picture = Picture(
        data,
        name,
        size_px=(image.width, image.height),
        file_dpi=image.dpi,
        world=image.world,
    )
    return _Read(picture, decoded)


def _actual(line: ImportedLine, name: str) -> ActualTrack | None:
    if line.elevations is None:
        return None
    import numpy as np

    return ActualTrack(name, np.column_stack([line.polyline.vertices, line.elevations]))


def _picture_in(mime: QMimeData) -> bytes | None:
    """Return a PNG file with the picture of the clipboard, as it was copied where that is possible."""
    copied = bytes(mime.data("image/png").data())
    if copied:
        return copied
    image = mime.imageData()
    if not isinstance(image, QImage) or image.isNull():
        return None
    from PIL import Image

    # Qt would write 96 dpi into every picture that says nothing of its own.
    whole = image.convertToFormat(QImage.Format.Format_RGBA8888)
    size = (whole.width(), whole.height())
    copy = Image.frombytes("RGBA", size, bytes(whole.constBits()), "raw", "RGBA", whole.bytesPerLine())
    file = io.BytesIO()
    (copy if image.hasAlphaChannel() else copy.convert("RGB")).save(file, "PNG")
    return file.getvalue()
