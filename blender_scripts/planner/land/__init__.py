"""The ground: its shape, its waters, its road and what covers it."""
