"""Curves, points and solids."""
