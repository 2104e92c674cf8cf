"""Signing by a certificate that nobody trusts, to try what a real one is for."""

from __future__ import annotations

import shlex
import subprocess
from pathlib import Path

from machine import TrialError

_NAME = "BobDesk test"


def make_signer(folder: Path) -> str:
    """Return a command that signs the file whose path it is given last, with a new certificate in `folder`."""
    folder.mkdir()
    key, certificate, command = folder / "key.pem", folder / "certificate.pem", folder / "sign"
    request = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", f"/CN={_NAME}"]
    request += ["-addext", "extendedKeyUsage=codeSigning", "-keyout", str(key), "-out", str(certificate)]
    subprocess.run(request, check=True, capture_output=True)
    sign = ["osslsigncode", "sign", "-h", "sha256", "-certs", str(certificate), "-key", str(key)]
    command.write_text(f'#!/bin/sh\n{shlex.join(sign)} -in "$1" -out "$1.signed" && mv "$1.signed" "$1"\n')
    command.chmod(0o755)
    return str(command)


def check_signature(program: Path, folder: Path) -> None:
    """Check the signature of a program by the certificate in `folder`.

    Raises
    ------
    TrialError
        If there is none, or it does not hold.
    """
    command = ["osslsigncode", "verify", "-ignore-crl", "-CAfile", str(folder / "certificate.pem"), "-in", str(program)]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode or f"CN={_NAME}" not in done.stdout:
        raise TrialError(f"the signature of {program.name} does not hold: {done.stdout[-500:]}")
