"""The licences of all that setup.exe brings along, for people and for programs."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Iterable
from importlib import metadata
from pathlib import Path

from house import HERE, HOUSE, identity, make_notices, python_parts
from interpreter import STEM
from part import Part, text_of
from wheels import INTERPRETER, sha256

_PRODUCT_VERSION = "ProductVersion".encode("utf-16le") + rb"\0*((?:[\d.]\0){5,})"
# Beside the packages. Name, licence, address, its text, and a file and the words in it that tell the version; the parts
# of Python that do not tell theirs are those of its version.
_OTHERS = (
    ("OpenSSL", "Apache-2.0", "https://openssl.org", "Apache-2.0", "libcrypto-3.dll", rb"OpenSSL (\d+\.\d+\.\d+) "),
    ("Expat", "MIT", "https://libexpat.github.io", "expat", "pyexpat.pyd", rb"expat_(\d+\.\d+\.\d+)"),
    ("libffi", "MIT", "https://sourceware.org/libffi", "libffi", f"{STEM}.dll", _PRODUCT_VERSION),
    ("zlib", "Zlib", "https://zlib.net", "zlib", f"{STEM}.dll", _PRODUCT_VERSION),
    ("bzip2", "bzip2-1.0.6", "https://sourceware.org/bzip2", "bzip2", f"{STEM}.dll", _PRODUCT_VERSION),
    ("liblzma", "public domain", "https://tukaani.org/xz", "xz", f"{STEM}.dll", _PRODUCT_VERSION),
    ("Microsoft Visual C++", "see its text", "", "microsoft-runtime", "vcruntime140.dll", _PRODUCT_VERSION),
    ("mingw-w64 and libgcc", "public domain; GPL-3.0 with exception", "https://mingw-w64.org", "mingw-w64", "", b""),
    ("NSIS", "Zlib; LZMA: CPL-1.0", "https://nsis.sourceforge.io", "nsis", "", b""),
)


def write_notices(tree: Path, downloads: Iterable[Path]) -> None:
    """Write the folder "licences" of the program that lies in `tree`.

    Parameters
    ----------
    downloads
        The wheels that it is made of.
    """
    folder = tree / "licences"
    folder.mkdir(parents=True)
    found = parts(tree / "runtime")
    without = [part.name for part in found if not part.texts]
    if without:
        raise SystemExit(f"there is no licence text of {', '.join(without)}")
    files = {
        "THIRD-PARTY-NOTICES.txt": make_notices.notices(found),
        f"{identity.PROGRAM}.cdx.json": bill(found, downloads),
    }
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\r\n" if name.endswith(".txt") else "\n")
    for name in ("LGPL-3.0.txt", "GPL-3.0.txt"):
        shutil.copyfile(HOUSE / "resources" / "licences" / name, folder / name)
    shutil.copyfile(HOUSE / "LICENSE", folder / "LICENSE.txt")


def parts(runtime: Path) -> list[Part]:
    """Return all works of others in the folder "runtime"."""
    python = _version(runtime / f"{STEM}.dll", _PRODUCT_VERSION)
    found = [python_parts.python(python)]
    packages = metadata.distributions(path=[str(runtime / "site-packages")])
    found += sorted((_package(one) for one in packages if one.metadata["Name"] != identity.PROGRAM), key=_by_name)
    for name, licence, address, text, library, words in _OTHERS:
        version = _version(runtime / library, words) if library else ""
        if library == f"{STEM}.dll":
            version = f"in Python {version}"
        places = (HERE / "licences" / f"{text}.txt", HOUSE / "resources" / "licences" / f"{text}.txt")
        texts = ((f"{text}.txt", text_of(next(place for place in places if place.exists()))),)
        found.append(Part(name, version, licence, address, texts))
    return found


def bill(found: Iterable[Part], downloads: Iterable[Path]) -> str:
    """Return the bill of materials, in CycloneDX's JSON."""
    sums = {_flat(path.name.split("-")[0]): sha256(path) for path in downloads}
    components = []
    for part in found:
        component: dict[str, object] = {"type": "library", "name": part.name, "bom-ref": part.name}
        component |= {"version": part.version, "licenses": [{"license": {"name": part.licence}}]}
        if part.packaged:
            component["purl"] = f"pkg:pypi/{part.name.lower().replace('_', '-')}@{part.version}"
            component["hashes"] = [{"alg": "SHA-256", "content": sums[_flat(part.name)]}]
        if part.name == "Python":
            component["description"] = f"DLLs as published by python.org, from the wheel of {INTERPRETER}"
        components.append(component)
    own = {"type": "application", "name": identity.PROGRAM, "version": identity.VERSION, "bom-ref": identity.PROGRAM}
    told = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "metadata": {"component": own},
        "components": components,
        "dependencies": [{"ref": identity.PROGRAM, "dependsOn": sorted(part.name for part in found)}],
    }
    return json.dumps(told, indent=2, ensure_ascii=False, sort_keys=True) + "\n"


def _package(package: metadata.Distribution) -> Part:
    name, told = package.metadata["Name"], package.metadata
    short = told.get("License-Expression") or _from_classifiers(told.get_all("Classifier") or []) or told.get("License")
    licence = python_parts.SHORT.get(_flat(name).replace("_", "-"), (short or "see its text").splitlines()[0])
    addresses = dict(text.split(", ", 1) for text in told.get_all("Project-URL") or [])
    lower = {label.lower(): address for label, address in addresses.items()}
    known = [lower.get(label) for label in ("homepage", "source", "source code", "repository", "website")]
    address = told.get("Home-page") or next((one for one in known if one), "")
    return Part(name, package.version, licence, address, tuple(python_parts.texts_of(package)), packaged=True)


def _from_classifiers(classifiers: Iterable[str]) -> str:
    return "; ".join(one.split(" :: ")[-1] for one in classifiers if one.startswith("License :: OSI Approved :: "))


def _by_name(part: Part) -> str:
    return part.name.lower()


def _flat(name: str) -> str:
    return re.sub(r"[-_.]+", "_", name).lower()


def _version(library: Path, words: bytes) -> str:
    told = re.search(words, library.read_bytes())
    if told is None:
        raise SystemExit(f"{library.name} does not tell its version")
    return told[1].replace(b"\0", b"").decode("ascii")
