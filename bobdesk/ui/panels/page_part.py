"""Page and resolution of a plan that is drawn from a PDF or SVG, or chosen from a TIFF of several pages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from bobdesk.plan.image import DPI_RANGE
from bobdesk.project import edits
from bobdesk.project.project import Picture, Project
from bobdesk.ui.notices import Remedy
from bobdesk.ui.plan_picture import DecodedPicture, decoded_picture_steps
from bobdesk.ui.runner import Job
from bobdesk.ui.widgets.panel import Panel
from bobdesk.ui.widgets.part import Part
from bobdesk.ui.widgets.spin import Spin, WholeSpin

if TYPE_CHECKING:
    from bobdesk.ui.session import Edit

_DRAWN = ("PDF", "SVG")


class PagePart(Part):
    """Two spin boxes; the page is drawn in the background before the project is changed."""

    def __init__(self, panel: Panel) -> None:
        super().__init__(panel)
        self.name_it(self.tr("Page"))
        self._job: Job | None = None
        form = panel.add_form(self.column)
        self.page = WholeSpin(self.tr("Page"), self)
        panel.add_field(form, self.tr("Page"), self.page, self.tr("Which page of the file is the plan"))
        self.page.valueChanged.connect(self._on_page)
        self.dpi = Spin(self.tr("Resolution"), self)
        self.dpi.setDecimals(0)
        self.dpi.setRange(*DPI_RANGE)
        self.dpi.setSingleStep(50)
        self.dpi.setSuffix(self.tr(" dpi"))
        panel.add_field(
            form,
            self.tr("Drawn at"),
            self.dpi,
            self.tr("Pixels per inch at which the page is drawn; what was placed on it stays in place"),
        )
        self.dpi.valueChanged.connect(self._on_dpi)
        self._form = form
        self.busy = panel.add_label(self.tr("Drawing the page…"), "muted", self.column)
        self.desk.session.document_changed.connect(self._stop)

    def refresh(self, project: Project) -> None:
        """Show page and resolution of a project's picture."""
        picture, image = project.picture, self.desk.picture.image
        if picture is None or image is None:
            self.setVisible(picture is not None and self._job is not None)
            return
        is_drawn, has_pages = image.format in _DRAWN, image.pages > 1
        self.setVisible(is_drawn or has_pages)
        self._form.setRowVisible(self.page, has_pages)
        self._form.setRowVisible(self.dpi, is_drawn)
        self.busy.setVisible(self._job is not None)
        if self._job is None:
            self.page.show_range(1, image.pages)
            self.page.setSuffix(self.tr(" of {count}").format(count=image.pages))
            self.page.show_value(picture.page)
            self.dpi.show_value(picture.dpi)

    def _on_dpi(self, dpi: float) -> None:

        picture = self.desk.session.project.picture
        if picture is None or dpi == picture.dpi:
            return

        def edit(drawn: Picture) -> Edit:
            return lambda project: edits.redraw_page(project, drawn)

        self._draw(picture, replace(picture, dpi=dpi), self.tr("Draw page at another resolution"), edit)

    def _on_page(self, page: int) -> None:
        project = self.desk.session.project
        picture = project.picture
        if picture is None or page == picture.page:
            return
        placed = project.trace is not None or project.control_points or project.known_distances
        if not (placed or project.check_distances):
            self._open_page(page)
            return
        self.page.show_value(picture.page)
        text = self.tr("Page {page} is another plan: line and points of this page would be put away.")
        self.desk.notices.warn(
            text.format(page=page),
            Remedy(self.tr("Open page {page}").format(page=page), lambda: self._open_page(page)),
        )

    def _open_page(self, page: int) -> None:

        picture = self.desk.session.project.picture
        if picture is None or page == picture.page:
            return

        def edit(drawn: Picture) -> Edit:
            return lambda project: edits.open_picture(project, drawn)

        self._draw(picture, replace(picture, page=page), self.tr("Open another page"), edit)

    def _draw(self, old: Picture, wanted: Picture, label: str, edit: Callable[[Picture], Edit]) -> None:
        self._stop()

        def done(decoded: DecodedPicture) -> None:
            self._job = None
            # Another plan may have been opened while the page was drawn.
            if self.desk.session.project.picture is old:
                image = decoded.image
                drawn = replace(wanted, size_px=(image.width, image.height), file_dpi=image.dpi)
                self.desk.picture.keep(drawn, decoded)
                self.desk.session.apply(label, edit(drawn))
            self.refresh(self.desk.session.project)

        def failed(sentence: str) -> None:
            self._job = None
            self.desk.notices.error(sentence)
            self.refresh(self.desk.session.project)

        def stopped() -> None:
            if self._job is job:
                self._job = None
                self.refresh(self.desk.session.project)

        job = self.desk.runner.start(
            self.tr("Drawing the page"),
            lambda: decoded_picture_steps(wanted),
            done=done,
            failed=failed,
            stopped=stopped,
        )
        self._job = job
        self.refresh(self.desk.session.project)

    def _stop(self) -> None:
        if self._job is not None:
            self._job.stop()
            self._job = None
