"""What macOS reads of the program: `Info.plist` of BobDesk.app, with the file type of projects.

python packaging/macos/bundle.py              prints it
python packaging/macos/bundle.py check APP    refuses an APP whose own is another one, or that lacks a file it names
"""

from __future__ import annotations

import plistlib
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import identity  # noqa: E402

APP = f"{identity.NAME}.app"
APP_ICON = "bobdesk.icns"
FILE_ICON = "bobdesk-project.icns"
# What can be dropped on the program's icon beside projects; other programs stay the ones that open them.
_ALSO_OPENED = ("public.image", "com.adobe.pdf", "public.comma-separated-values-text", "public.geojson")


def info_plist() -> dict[str, object]:
    """Return what `Info.plist` says."""
    return {
        "CFBundleName": identity.NAME,
        "CFBundleDisplayName": identity.NAME,
        "CFBundleExecutable": identity.PROGRAM,
        "CFBundleIdentifier": identity.APP_ID,
        "CFBundleIconFile": APP_ICON,
        "CFBundlePackageType": "APPL",
        "CFBundleShortVersionString": identity.VERSION,
        "CFBundleVersion": identity.VERSION,
        "CFBundleDevelopmentRegion": "en",
        # Numbers and Qt's own dialogs follow the system's language, whatever the program's texts are in.
        "CFBundleAllowMixedLocalizations": True,
        "LSApplicationCategoryType": "public.app-category.productivity",
        "LSMinimumSystemVersion": identity.MACOS_MINIMUM,
        "NSHighResolutionCapable": True,
        "NSHumanReadableCopyright": identity.COPYRIGHT,
        "NSPrincipalClass": "NSApplication",
        # Dark as the system is.
        "NSRequiresAquaSystemAppearance": False,
        "NSSupportsAutomaticGraphicsSwitching": True,
        "CFBundleDocumentTypes": [
            {
                "CFBundleTypeName": identity.FILE_TYPE_NAME,
                "CFBundleTypeRole": "Editor",
                "CFBundleTypeIconFile": FILE_ICON,
                "LSHandlerRank": "Owner",
                "LSItemContentTypes": [identity.FILE_TYPE_UTI],
            },
            {
                "CFBundleTypeName": "Plan of a track",
                "CFBundleTypeRole": "Viewer",
                "LSHandlerRank": "Alternate",
                "LSItemContentTypes": list(_ALSO_OPENED),
            },
        ],
        "UTExportedTypeDeclarations": [
            {
                "UTTypeIdentifier": identity.FILE_TYPE_UTI,
                "UTTypeDescription": identity.FILE_TYPE_NAME,
                "UTTypeIconFile": FILE_ICON,
                # A ZIP by its bytes, but nothing to unpack by a double click.
                "UTTypeConformsTo": ["public.data", "public.content"],
                "UTTypeTagSpecification": {
                    "public.filename-extension": [identity.FILE_SUFFIX],
                    "public.mime-type": identity.MIME_TYPE,
                },
            }
        ],
    }


def problems(app: Path) -> list[str]:
    """Return what is not as it should be in a bundle, a sentence each."""
    contents = app / "Contents"
    found = plistlib.loads((contents / "Info.plist").read_bytes())
    wrong = [
        f"Info.plist says {found.get(name)!r} of {name}, not {value!r}"
        for name, value in info_plist().items()
        if found.get(name) != value
    ]
    places = (
        f"MacOS/{identity.PROGRAM}",
        *(f"Resources/{name}" for name in (APP_ICON, FILE_ICON, "resources/samples")),
    )
    return wrong + [f"there is no Contents/{place}" for place in places if not (contents / place).exists()]


def main(arguments: list[str]) -> int:
    match arguments:
        case []:
            sys.stdout.buffer.write(plistlib.dumps(info_plist()))
        case ["check", app]:
            wrong = problems(Path(app))
            print("\n".join(wrong), file=sys.stderr)
            return 1 if wrong else 0
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
