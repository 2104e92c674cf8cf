"""One table of actions, from which menus, tool bars, keys and the command palette are made."""
