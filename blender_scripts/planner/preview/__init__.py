"""Plans of the preview: a map of a scene and colour stills."""
