"""Read the feed over the network, without waiting, and without saying who asks."""

from __future__ import annotations

from PySide6.QtCore import QObject, QUrl, Signal
from PySide6.QtNetwork import QNetworkAccessManager, QNetworkReply, QNetworkRequest

from bobdesk.errors import InputError
from bobdesk.ui.updates.release_feed import is_safe, release_in

_TIMEOUT_MS = 10_000
_LARGEST = 1_000_000
_MOST_REDIRECTS = 5
# The program's name without version, system or language: servers may refuse who has no name.
_HEADERS = {
    b"User-Agent": b"BobDesk",
    b"Accept": b"application/json",
    b"Accept-Language": b"en",
    b"Accept-Encoding": b"identity",  # a small answer cannot grow to a large one
}
_OF = QNetworkRequest.Attribute
_ERROR = QNetworkReply.NetworkError
_OFFLINE = (
    _ERROR.HostNotFoundError,
    _ERROR.ConnectionRefusedError,
    _ERROR.NetworkSessionFailedError,
    _ERROR.TemporaryNetworkFailureError,
    _ERROR.UnknownNetworkError,
)


class FeedReader(QObject):
    """One question at a time.

    Signals
    -------
    answered
        A `Release`.
    failed
        A sentence for the user.
    """

    answered = Signal(object)
    failed = Signal(str)

    def __init__(self, parent: QObject | None = None, *, timeout_ms: int = _TIMEOUT_MS) -> None:
        super().__init__(parent)
        self._timeout_ms = timeout_ms
        self._network = QNetworkAccessManager(self)
        self._network.setRedirectPolicy(QNetworkRequest.RedirectPolicy.UserVerifiedRedirectPolicy)
        self._reply: QNetworkReply | None = None
        self._is_too_large = False

    @property
    def is_busy(self) -> bool:
        """Whether an answer is still to come."""
        return self._reply is not None

    def ask(self, address: str) -> None:
        """Ask an address; nothing happens while another question is under way."""
        if self._reply is not None:
            return
        request = QNetworkRequest(QUrl(address))
        for name, value in _HEADERS.items():
            request.setRawHeader(name, value)
        request.setTransferTimeout(self._timeout_ms)
        request.setMaximumRedirectsAllowed(_MOST_REDIRECTS)
        for of in (_OF.CookieLoadControlAttribute, _OF.CookieSaveControlAttribute, _OF.AuthenticationReuseAttribute):
            request.setAttribute(of, QNetworkRequest.LoadControl.Manual.value)
        request.setAttribute(_OF.CacheLoadControlAttribute, QNetworkRequest.CacheLoadControl.AlwaysNetwork.value)
        self._is_too_large = False
        reply = self._network.get(request)
        reply.redirected.connect(self._on_redirected)
        # No more is ever held; one byte over it and the answer is dropped.
        reply.setReadBufferSize(_LARGEST + 1)
        reply.readyRead.connect(self._on_ready)
        reply.finished.connect(self._on_finished)
        self._reply = reply

    def drop(self) -> None:
        """Want no answer any more."""
        reply, self._reply = self._reply, None
        if reply is not None:
            reply.abort()
            reply.deleteLater()

    def _on_redirected(self, address: QUrl) -> None:
        if self._reply is None:
            return
        goes_back = self._reply.url().scheme() == "https" and address.scheme() != "https"
        if is_safe(address.toString()) and not goes_back:
            self._reply.redirectAllowed.emit()
        else:
            self._reply.abort()

    def _on_ready(self) -> None:
        if self._reply is not None and self._reply.bytesAvailable() > _LARGEST:
            self._is_too_large = True
            self._reply.abort()

    def _on_finished(self) -> None:
        reply, self._reply = self._reply, None
        if reply is None:
            return  # dropped
        reply.deleteLater()
        host = reply.request().url().host()
        if reply.error() != _ERROR.NoError:
            self.failed.emit(self._why(reply, host))
            return
        try:
            release = release_in(bytes(reply.readAll().data()))
        except InputError as error:
            self.failed.emit(self.tr("{host} cannot be understood: {reason}.").format(host=host, reason=error))
            return
        self.answered.emit(release)

    def _why(self, reply: QNetworkReply, host: str) -> str:
        error = reply.error()
        if self._is_too_large:
            return self.tr("{host} cannot be understood: what it answers is too long.").format(host=host)
        if error in _OFFLINE:
            return self.tr("{host} cannot be reached; is this computer online?").format(host=host)
        if error in (_ERROR.OperationCanceledError, _ERROR.TimeoutError):
            return self.tr("{host} has not answered in time; try again later.").format(host=host)
        if error == _ERROR.SslHandshakeFailedError:
            return self.tr("The connection to {host} is not safe, so nothing was read.").format(host=host)
        status = reply.attribute(QNetworkRequest.Attribute.HttpStatusCodeAttribute)
        if isinstance(status, int):
            return self.tr("{host} does not tell of versions now (HTTP {status}); try again later.").format(
                host=host, status=status
            )
        return self.tr("{host} could not be asked: {reason}").format(host=host, reason=reply.errorString())
