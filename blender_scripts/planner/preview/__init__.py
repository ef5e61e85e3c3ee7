"""Plans of the preview: a map of a place and colour stills."""
