"""Commands without a window; each is one file and calls the same functions as the window."""
