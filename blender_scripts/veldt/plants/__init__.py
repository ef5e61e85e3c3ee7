"""What grows and stands about: where, and how it looks."""
