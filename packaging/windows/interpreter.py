"""Python for Windows, put together without Windows.

Its DLLs and extension modules are the files of python.org, signed by the Python Software Foundation, out of a wheel
that carries them along. Its library in pure Python is that of the interpreter which builds, of the same minor
version. `python3.dll`, which hands calls of the stable interface on to `python311.dll`, is made here.
"""

from __future__ import annotations

import py_compile
import subprocess
import sysconfig
import zipfile
from pathlib import Path

from pe import PortableExecutable
from trim import wants_interpreter, wants_library
from wheels import PYTHON

STEM = f"python{PYTHON[0]}{PYTHON[1]}"
GCC = "x86_64-w64-mingw32-gcc"
REPRODUCIBLE = ["-s", "-static-libgcc", "-Wl,--no-insert-timestamp"]
HARDENED = ["-Wl,--dynamicbase", "-Wl,--nxcompat", "-Wl,--high-entropy-va"]
_NOTHING_TO_DO = (
    "int __stdcall DllMainCRTStartup(void *h, unsigned r, void *p) { (void)h, (void)r, (void)p; return 1; }\n"
)


def write_interpreter(wheel: Path, runtime: Path, dated: tuple[int, int, int, int, int, int]) -> None:
    """Write the interpreter into the folder `runtime`.

    Parameters
    ----------
    wheel
        The wheel that brings the DLLs.
    dated
        The date of everything in the archive of the library.
    """
    with zipfile.ZipFile(wheel) as archive:
        for name in archive.namelist():
            folder, _, file = name.rpartition("/")
            if folder == "deploy_libs" and file and wants_interpreter(file):
                (runtime / file).write_bytes(archive.read(name))
    write_library(runtime / f"{STEM}.zip", dated)
    # With this file the interpreter looks nowhere else: not at the registry, not at PYTHONPATH.
    (runtime / f"{STEM}._pth").write_text(f"{STEM}.zip\n.\nsite-packages\n", encoding="ascii")
    write_forwarder(runtime / f"{STEM}.dll", runtime / "python3.dll")


def write_library(path: Path, dated: tuple[int, int, int, int, int, int]) -> None:
    """Write the compiled library as one archive, uncompressed: setup.exe compresses it better."""
    library = Path(sysconfig.get_path("stdlib"))
    compiled = path.with_suffix(".pyc")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        for source in sorted(library.rglob("*.py")):
            name = source.relative_to(library).as_posix()
            if wants_library(name):
                compile_file(source, f"{STEM}.zip/{name}", compiled)
                archive.writestr(zipfile.ZipInfo(f"{name}c", dated), compiled.read_bytes())
    compiled.unlink()


def compile_file(source: Path, shown: str, target: Path | None = None) -> None:
    """Compile a module such that the result does not depend on where and when that is done.

    Parameters
    ----------
    shown
        The path that is shown in a traceback.
    target
        Where to; None is where Python looks for it.
    """
    py_compile.compile(
        str(source),
        cfile=None if target is None else str(target),
        dfile=shown,
        doraise=True,
        invalidation_mode=py_compile.PycInvalidationMode.UNCHECKED_HASH,
    )


def write_forwarder(library: Path, forwarder: Path) -> None:
    """Write a DLL that hands everything which `library` offers on to it."""
    names = sorted(PortableExecutable(library).exports())
    code, exports = forwarder.with_suffix(".c"), forwarder.with_suffix(".def")
    code.write_text(_NOTHING_TO_DO, encoding="ascii")
    lines = [f'  "{name}" = "{library.stem}.{name}"' for name in names]
    exports.write_text("\n".join([f'LIBRARY "{forwarder.name}"', "EXPORTS", *lines, ""]), encoding="ascii")
    # The linker would choose an address by the path that it writes to.
    command = [GCC, "-shared", "-nostdlib", "-Wl,-e,DllMainCRTStartup", "-Wl,--disable-auto-image-base"]
    command += [*REPRODUCIBLE, *HARDENED]
    subprocess.run([*command, "-o", str(forwarder), str(code), str(exports)], check=True)
    code.unlink()
    exports.unlink()
