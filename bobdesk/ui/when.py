"""Moments as a person names them: today, yesterday, Monday, 12 Nov."""

from __future__ import annotations

from datetime import datetime

from PySide6.QtCore import QDate, QLocale, QObject, QTime

_DAYS_OF_A_WEEK = 7


class Moments(QObject):
    """Names moments in the user's language."""

    def text(self, seconds: float, *, now: float | None = None) -> str:
        """Return a moment in words.

        Parameters
        ----------
        seconds, now
            Since 1970; `now` is the clock's time if None.
        """
        moment = _moment(seconds)
        if moment is None:
            return ""
        today = (datetime.now() if now is None else datetime.fromtimestamp(now)).date()
        days = (today - moment.date()).days
        if days == 0:
            return self.tr("today {time}").format(time=self.time(seconds))
        if days == 1:
            return self.tr("yesterday")
        locale = QLocale()
        if 1 < days < _DAYS_OF_A_WEEK:
            return locale.standaloneDayName(moment.isoweekday())
        date = QDate(moment.year, moment.month, moment.day)
        # dates of other years, and clocks that were set wrong, show their year
        return locale.toString(date, "d MMM" if moment.year == today.year and days > 0 else "d MMM yyyy")

    def time(self, seconds: float) -> str:
        """Return the time of the day, as the user's country writes it."""
        moment = _moment(seconds)
        if moment is None:
            return ""
        return QLocale().toString(QTime(moment.hour, moment.minute), QLocale.FormatType.ShortFormat)


def _moment(seconds: float) -> datetime | None:
    try:
        return datetime.fromtimestamp(seconds)
    except (ValueError, OverflowError, OSError):
        return None
