"""Scene planning for Veldt: pure Python and NumPy, without bpy; results are the same on every machine."""
