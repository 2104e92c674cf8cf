"""The program tries itself out where it is installed: opens its window unseen, does the main job, and reports."""
