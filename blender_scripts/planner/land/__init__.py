"""The ground: its shape, waters, road and covers."""
