"""The tables of keys in the guide, made from the actions: they show the keys in force."""

from __future__ import annotations

from bobdesk.ui.actions.action_set import ActionSet
from bobdesk.ui.dialogs.menu_names import MenuNames
from bobdesk.ui.dialogs.shortcut_changes import native


def keys_tables(actions: ActionSet) -> str:
    """Return a Markdown table of every action with a key, one for each menu."""
    menus = MenuNames(actions)
    tables: dict[str, list[str]] = {}
    for row in actions.table:
        keys = [f"`{native(key).replace('`', '')}`" for key in actions.keys_of(row)]
        if keys:
            # A bar would end the cell.
            name, shown = row.plain_text.replace("|", "/"), " or ".join(keys).replace("|", "\\|")
            where = "plan" if row.scope == "canvas" else "window"
            tables.setdefault(menus.text(row.menu), []).append(f"| {name} | {shown} | {where} |")
    head = "| Action | Key | Acts in the |\n|---|---|---|\n"
    return "\n\n".join(f"## {menu}\n\n{head}" + "\n".join(rows) for menu, rows in tables.items())
