"""Flights: where the camera goes and where it looks."""
