"""Flights: paths and viewing directions of the camera."""
