# SPDX-License-Identifier: GPL-3.0-or-later
"""Veldt in Blender: labelled thermal frames of your own scene, from the sidebar of the 3D view.

Modules that need bpy are imported when Blender enables the extension, so that the others can be used without Blender.
"""


def register() -> None:
    """Called by Blender when the extension is enabled."""
    import bpy

    from . import properties

    properties.register()
    for each in _classes():
        bpy.utils.register_class(each)


def unregister() -> None:
    """Called by Blender when the extension is disabled."""
    import bpy

    from . import properties

    for each in reversed(_classes()):
        bpy.utils.unregister_class(each)
    properties.unregister()


def _classes() -> tuple[type, ...]:
    from . import assignments, operators, panel

    return (*assignments.CLASSES, *operators.CLASSES, *panel.CLASSES)
