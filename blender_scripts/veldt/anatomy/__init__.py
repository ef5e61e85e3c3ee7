"""Bodies: their bones, and how they stand and walk."""
