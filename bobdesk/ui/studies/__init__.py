"""Windows beside the main one: methods side by side, studies, the published tables."""
