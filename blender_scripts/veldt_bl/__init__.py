"""Build and render a planned scene in Blender; the only modules that import bpy."""
