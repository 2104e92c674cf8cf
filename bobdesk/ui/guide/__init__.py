"""The user's guide: its pages, its window, and which page explains what is in focus."""
