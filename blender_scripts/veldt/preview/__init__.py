"""What a map and stills of a place show."""
