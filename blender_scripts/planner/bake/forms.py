"""Names and version of the files of a plan."""

PLAN, SCENE, TRACK, PREVIEW = "veldt-plan", "veldt-scene", "veldt-track", "veldt-preview"
VERSION = 1
