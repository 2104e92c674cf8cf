"""What Wine 8 lacks and every Windows 10 has, for the test of setup.exe alone: none of it is ever installed.

usage: python shims.py TREE FOLDER     writes the libraries that the programs in TREE need into FOLDER, and prints their
                                       names

- ucrtbase.dll: Wine's has the complex functions of C99 only by name. The one made here has them, and hands everything
  else on to a renamed copy of Wine's.
- icuuc.dll: functions that do nothing; Qt asks it for rare text codecs.
- bcryptprimitives.dll: random numbers, for hash tables.
"""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from interpreter import GCC
from pe import PortableExecutable, executables

WINE_MARK = b"Wine builtin DLL"  # Wine takes a file with it for its own and looks for the Unix half beside it
WINE_COPY = "ucrtbas0"

_COMPLEX = re.compile(r"(c(?:a?(?:cos|sin|tan)h?|exp|log|log10|sqrt|pow|proj|conj|abs|arg|real|imag))(f?)")
_C_HEAD = """#include <complex.h>
typedef struct { double re, im; } zd;
typedef struct { float re, im; } zf;
static double complex in_d(zd a) { double complex z; __real__ z = a.re; __imag__ z = a.im; return z; }
static float complex in_f(zf a) { float complex z; __real__ z = a.re; __imag__ z = a.im; return z; }
static zd out_d(double complex z) { zd a = {creal(z), cimag(z)}; return a; }
static zf out_f(float complex z) { zf a = {crealf(z), cimagf(z)}; return a; }
"""
_RANDOM = """#include <windows.h>
BOOLEAN NTAPI SystemFunction036(void *, ULONG);
BOOL WINAPI ProcessPrng(unsigned char *data, size_t length) { return SystemFunction036(data, (ULONG)length); }
"""


def main() -> None:
    tree, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    made = [write_c_library(functions_of("api-ms-win-crt-math", tree), folder), f"{WINE_COPY}.dll"]
    if unicode := functions_of("icuuc.dll", tree):
        code = "\n".join(f"void *{name}(void) {{ return 0; }}" for name in sorted(unicode))
        made.append(compile_library(folder / "icuuc.dll", code, unicode))
    if functions_of("bcryptprimitives.dll", tree):
        made.append(compile_library(folder / "bcryptprimitives.dll", _RANDOM, ["ProcessPrng"], "-ladvapi32"))
    print("\n".join(made))


def functions_of(library: str, tree: Path) -> set[str]:
    """Return what the programs in a folder take from the libraries whose names begin with `library`."""
    found: set[str] = set()
    for path in executables(tree):
        for name, functions in PortableExecutable(path).imports().items():
            if name.startswith(library):
                found |= functions
    return found


def write_c_library(wanted: Iterable[str], folder: Path) -> str:
    """Write ucrtbase.dll with the complex functions among `wanted`."""
    own = next(iter(sorted(Path("/usr/lib").glob("**/x86_64-windows/ucrtbase.dll"))), None)
    if own is None:
        sys.exit("Wine's ucrtbase.dll is not found; on Debian: apt-get install wine64")
    data = own.read_bytes()
    (folder / f"{WINE_COPY}.dll").write_bytes(data.replace(WINE_MARK, b"\0" * len(WINE_MARK), 1))
    complex_ones = {name: found for name in sorted(wanted) if (found := _COMPLEX.fullmatch(name))}
    code = _C_HEAD + "\n".join(complex_function(*found.groups()) for found in complex_ones.values())
    exports = [f'"{name}" = own_{name}' for name in complex_ones]
    others = PortableExecutable(own).exports() - set(complex_ones)
    exports += [f'"{name}" = "{WINE_COPY}.{name}"' for name in sorted(others)]
    return compile_library(folder / "ucrtbase.dll", code, exports)


def complex_function(name: str, single: str) -> str:
    """Return the C code of a function, such as cabs or cexpf, by the conventions of Windows."""
    kind, number, suffix = ("f", "float", "f") if single else ("d", "double", "")
    result = number if name in ("cabs", "carg", "creal", "cimag") else f"z{kind}"
    given = f"z{kind} a, z{kind} b" if name == "cpow" else f"z{kind} a"
    call = f"{name}{suffix}(in_{kind}(a){f', in_{kind}(b)' if name == 'cpow' else ''})"
    return f"{result} own_{name}{single}({given}) {{ return {call if result == number else f'out_{kind}({call})'}; }}"


def compile_library(path: Path, code: str, exports: Iterable[str], *libraries: str) -> str:
    """Compile C code into a library, and return its name."""
    source, listed = path.with_suffix(".c"), path.with_suffix(".def")
    source.write_text(code + "\n", encoding="ascii")
    listed.write_text("\n".join([f'LIBRARY "{path.name}"', "EXPORTS", *(f"  {one}" for one in exports), ""]))
    command = [GCC, "-O1", "-fno-builtin", "-shared", "-s", "-static-libgcc", "-o", str(path), str(source), str(listed)]
    subprocess.run([*command, *libraries], check=True)
    return path.name


if __name__ == "__main__":
    main()
