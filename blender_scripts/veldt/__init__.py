"""Plans a Veldt scene: pure Python and numpy, no bpy, the same answer on every machine."""
